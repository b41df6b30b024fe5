#include "suspension_health_monitor/internal/simulation/accelerometer.h"

#include <array>
#include <cmath>

namespace suspension_health_monitor {
namespace {

// By place.
constexpr std::array kNoise{RandomPurpose::kSprungNoise, RandomPurpose::kUnsprungNoise, RandomPurpose::kRoadNoise};
constexpr std::array kDelivery{RandomPurpose::kSprungDelivery, RandomPurpose::kUnsprungDelivery,
                               RandomPurpose::kRoadDelivery};

}  // namespace

Accelerometer::Accelerometer(const SimulationOptions& options, Place place)
    : noise_random_(options.seed, kNoise[static_cast<std::size_t>(place)]),
      delivery_random_(options.seed, kDelivery[static_cast<std::size_t>(place)]),
      noise_(options.noise),
      gaussian_(options.gaussian_noise),
      dropout_(options.dropout),
      stamp_jitter_(options.stamp_jitter),
      clock_offset_(place == Place::kSprung ? options.clock_offset : 0.0),
      clock_rate_(place == Place::kSprung ? 1.0 + options.clock_skew : 1.0) {}

std::optional<AccelerometerReading> Accelerometer::read(double t, double acceleration) {
  const double measured = acceleration + drawNoise();
  const bool lost = delivery_random_.uniform() < dropout_;
  const double delay = stamp_jitter_ * delivery_random_.uniform();
  if (lost) return std::nullopt;
  return AccelerometerReading{fromSeconds(clock_offset_ + clock_rate_ * t + delay), measured};
}

double Accelerometer::drawNoise() {
  // A uniform variable of half-width h has the standard deviation h / sqrt(3).
  if (gaussian_) return noise_ * noise_random_.gaussian();
  return noise_ * std::sqrt(3.0) * (2.0 * noise_random_.uniform() - 1.0);
}

}  // namespace suspension_health_monitor
