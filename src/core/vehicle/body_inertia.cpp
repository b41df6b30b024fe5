#include "suspension_health_monitor/internal/vehicle/body_inertia.h"

#include <cmath>

#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {
namespace {

constexpr double kCertain = 3.0;  // standard deviations: by chance once in a thousand

bool isCertain(const Measured& number) { return number.value > kCertain * number.stddev; }

}  // namespace

BodyInertiaResult inertiaOf(const std::optional<BodyFitResult>& fit, const StrutPlaces& places) {
  if (places.empty()) return {{}, InertiaDoubt::kNoPositions};
  if (!fit) return {{}, InertiaDoubt::kUncertain};
  const BodyInertia body{fit->mass_to_pitch_inertia, fit->mass_to_roll_inertia, fit->x, fit->y};
  if (!std::isfinite(body.mass_to_pitch_inertia.stddev) || !std::isfinite(body.mass_to_roll_inertia.stddev))
    return {{}, InertiaDoubt::kOnOneLine};
  if (!isCertain(body.mass_to_pitch_inertia) || !isCertain(body.mass_to_roll_inertia))
    return {{}, InertiaDoubt::kUncertain};
  return {body, InertiaDoubt::kNone};
}

}  // namespace suspension_health_monitor
