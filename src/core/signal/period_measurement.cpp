#include "suspension_health_monitor/signal/period_measurement.h"

#include <algorithm>

namespace suspension_health_monitor {

void PeriodMeasurement::add(Side side, Stamp stamp) {
  const auto index = static_cast<std::size_t>(side);
  if (last_[index] && stamp > *last_[index]) spacings_[index].push_back(stamp - *last_[index]);
  last_[index] = stamp;
}

std::optional<double> PeriodMeasurement::period() const {
  double slower = 0.0;
  for (std::vector<Stamp> spacings : spacings_) {
    if (spacings.size() < spacings_wanted_) return std::nullopt;
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    slower = std::max(slower, toSeconds(*middle));
  }
  return slower;
}

}  // namespace suspension_health_monitor
