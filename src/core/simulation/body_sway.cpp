#include "suspension_health_monitor/internal/simulation/body_sway.h"

#include <cmath>

#include "suspension_health_monitor/internal/simulation/scenario.h"

namespace suspension_health_monitor {
namespace {

constexpr int kNumSines = 24;

}  // namespace

BodySway::BodySway(const SimulationOptions& options) {
  RandomStream random(options.seed, RandomPurpose::kSway);
  const auto draw = [&](double rms, double lowest, double highest) {
    Sines sines;
    for (int i = 0; i < kNumSines; ++i) {
      const double share = (i + random.uniform()) / kNumSines;  // spread evenly by ratio
      sines.push_back({rms * std::sqrt(2.0 / kNumSines), 2.0 * M_PI * lowest * std::pow(highest / lowest, share),
                       2.0 * M_PI * random.uniform()});
    }
    return sines;
  };
  for (Sines& sines : accelerations_) sines = draw(options.body_acceleration, 0.1, 1.0);
  for (Sines& sines : rates_) sines = draw(options.body_rate, 0.3, 4.0);
}

Sway BodySway::at(double t) const {
  Sway sway;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (const Sine& s : accelerations_[axis])
      sway.acceleration[axis] += s.amplitude * std::sin(s.frequency * t + s.phase);
    for (const Sine& s : rates_[axis]) {
      sway.angular_rate[axis] += s.amplitude * std::sin(s.frequency * t + s.phase);
      sway.angular_acceleration[axis] += s.amplitude * s.frequency * std::cos(s.frequency * t + s.phase);
    }
  }
  return sway;
}

}  // namespace suspension_health_monitor
