#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/signal/uniform_grid.h"

namespace suspension_health_monitor {

/// The sampling time of a strut's two streams, measured from their stamps, of the slower stream: the mean of all
/// spacings within half and one and a half times their median. The median passes over gaps and clocks that jump, as
/// long as they are the minority; the mean takes the jitter of n stamps down to 1/n of it. The road's stamps have no
/// say.
class PeriodMeasurement {
 public:
  /// @param spacings_wanted  of each stream before a period is given, >= 1.
  explicit PeriodMeasurement(std::size_t spacings_wanted) : spacings_wanted_(spacings_wanted) {}

  /// @return false if the stamp is the same as the one before: it tells nothing.
  bool add(Side side, Stamp stamp);

  /// @return true if the stamp is older than the one before of its stream.
  bool goesBack(Side side, Stamp stamp) const {
    const std::optional<Stamp>& last = last_[static_cast<std::size_t>(side)];
    return last && stamp < *last;
  }

  /// @return the sampling time [s], nothing until both streams have shown enough spacings.
  std::optional<double> period() const;

 private:
  std::size_t spacings_wanted_;
  std::array<std::optional<Stamp>, kMostStreams> last_;
  std::array<std::vector<Stamp>, 2> spacings_;  // of the strut's sensors
};

}  // namespace suspension_health_monitor
