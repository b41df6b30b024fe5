#include "suspension_health_monitor/internal/signal/period_measurement.h"

#include <algorithm>

namespace suspension_health_monitor {

bool PeriodMeasurement::add(Side side, Stamp stamp) {
  const auto index = static_cast<std::size_t>(side);
  if (last_[index] == stamp) return false;
  const bool counts = index < spacings_.size() && last_[index] && stamp > *last_[index];
  if (counts) spacings_[index].push_back(stamp - *last_[index]);
  last_[index] = stamp;
  return true;
}

std::optional<double> PeriodMeasurement::period() const {
  if (spacings_[0].size() < spacings_wanted_ || spacings_[1].size() < spacings_wanted_) return std::nullopt;
  double slower = 0.0;
  for (std::vector<Stamp> spacings : spacings_) {
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    const Stamp median = *middle;
    Stamp sum{};
    int count = 0;
    for (const Stamp spacing : spacings) {
      if (2 * spacing <= median || 2 * spacing >= 3 * median) continue;
      sum += spacing;
      ++count;
    }
    slower = std::max(slower, toSeconds(sum) / count);
  }
  return slower;
}

}  // namespace suspension_health_monitor
