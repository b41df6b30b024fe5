#include "suspension_health_monitor/internal/blocks/sliding_friction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "suspension_health_monitor/internal/blocks/tuning.h"

namespace suspension_health_monitor {

double SlidingFriction::push(double time, double wheel) {
  const double spacing = time_ ? time - *time_ : 0.0;
  time_ = time;
  if (!(spacing > 0.0) || spacing > memory_) {
    mean_ = wheel_ = wheel;
    variance_ = travel_ = rate_ = 0.0;
    return 0.0;
  }
  const double share = spacing / memory_;
  mean_ += share * (wheel - mean_);
  variance_ += share * ((wheel - mean_) * (wheel - mean_) - variance_);
  const double friction =
      std::max({friction_, kBlockTuning.least_friction * std::sqrt(variance_), std::numeric_limits<double>::min()});
  const int steps = static_cast<int>(std::ceil(spacing / longest_step_));
  const double h = spacing / steps, damped = 1.0 / (1.0 + h * (b1_ + h * b0_)), limit = h * friction * damped;
  const double of_drive = h * damped, of_travel = of_drive * b0_, slope = (wheel - wheel_) / steps;
  double drive = wheel_ - mean_, free = 0.0;
  for (int i = 0; i < steps; ++i) {
    drive += slope;
    free = damped * rate_ + (of_drive * drive - of_travel * travel_);
    rate_ = std::copysign(std::max(std::abs(free) - limit, 0.0), free);
    travel_ += h * rate_;
  }
  wheel_ = wheel;
  return (free - rate_) / limit;
}

}  // namespace suspension_health_monitor
