#include "suspension_health_monitor/internal/record/motion_scale.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {

double MotionScale::unit(ShapeScale scale) const {
  switch (scale) {
    case ShapeScale::kTravel: return travel;
    case ShapeScale::kTravelRate: return travel_rate;
    case ShapeScale::kTime: return time;
    case ShapeScale::kFrequency: return 1.0 / (2.0 * M_PI * time);
    case ShapeScale::kNone: break;
  }
  return 1.0;
}

bool hasShapeAtEnd(const ActiveEffect& active, const MotionScale& scale) {
  constexpr double end = 0.01;
  for (std::size_t i = 0; i < active.shapes.size(); ++i) {
    const ShapeParameter& shape = active.effect.shapes[i];
    const double lowest = scale.unit(shape.scale) * shape.min;
    const double place = std::log(active.shapes[i] / lowest) / std::log(shape.max / shape.min);
    if ((!(place < 1.0 - end) && !shape.open_above) || (place < end && !shape.open_below)) return true;
  }
  return false;
}

std::optional<MotionScale> motionScale(const std::vector<CornerSample>& samples, double period, double damping_to_mass,
                                       double stiffness_to_mass) {
  FreeRun free_run(period);
  if (!free_run.trySetModel(damping_to_mass, stiffness_to_mass)) return std::nullopt;
  double count = 0.0, travel = 0.0, travel_square = 0.0, rate_square = 0.0;
  const CornerSample* last = nullptr;
  for (const CornerSample& sample : samples) {
    if (last != nullptr && continuity(sample.stamp - last->stamp, fromSeconds(period)) != Continuity::kContinues)
      free_run.reset();
    last = &sample;
    if (!free_run.push(sample.unsprung_acceleration) || !free_run.settled()) continue;
    count += 1.0;
    travel += free_run.travel();
    travel_square += free_run.travel() * free_run.travel();
    rate_square += free_run.travelRate() * free_run.travelRate();
  }
  if (count < 2.0) return std::nullopt;
  const double mean = travel / count;
  const MotionScale scale{std::sqrt(std::max(0.0, travel_square / count - mean * mean)), std::sqrt(rate_square / count),
                          1.0 / std::sqrt(stiffness_to_mass)};
  if (!(scale.travel > 0.0 && scale.travel_rate > 0.0)) return std::nullopt;
  return scale;
}

}  // namespace suspension_health_monitor
