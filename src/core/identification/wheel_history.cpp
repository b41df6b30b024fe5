#include "suspension_health_monitor/internal/identification/wheel_history.h"

#include <cmath>

namespace suspension_health_monitor {

WheelHistory::WheelHistory(const IntegralFilterOptions& options, double reach)
    : filter_(2, options),
      period_(options.period),
      delay_(static_cast<int>(std::ceil(reach / options.period)) + 1),
      missing_(2 * delay_ + 1),
      output_(2 * delay_ + 1),
      damping_(2 * delay_ + 1),
      stiffness_(2 * delay_ + 1) {}

void WheelHistory::push(double acceleration) {
  filter_.push(acceleration);
  if (!filter_.full()) return;
  output_.push(filter_.output(2));
  damping_.push(filter_.output(1));
  stiffness_.push(filter_.output(0));
  if (!full()) --missing_;
}

WheelHistory::Place WheelHistory::place(double shift) const {
  const double samples = shift / period_, whole = std::floor(samples), u = samples - whole, v = 1.0 - u;
  Place place{};
  place.age = delay_ - 1 - static_cast<int>(whole);
  place.before = (1.0 + 2.0 * u) * v * v;
  place.after = u * u * (3.0 - 2.0 * u);
  place.slope_before = period_ * u * v * v;
  place.slope_after = -period_ * u * u * v;
  place.share = u;
  return place;
}

void WheelHistory::reset() {
  filter_.reset();
  missing_ = 2 * delay_ + 1;
}

}  // namespace suspension_health_monitor
