#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/signal/uniform_grid.h"

namespace suspension_health_monitor {

/// The sampling time of two streams, measured from their stamps: the median spacing, of the slower stream.
/// The median passes over gaps, repeated stamps and clocks that jump, as long as they are the minority.
class PeriodMeasurement {
 public:
  /// @param spacings_wanted  of each stream before a period is given, >= 1.
  explicit PeriodMeasurement(std::size_t spacings_wanted) : spacings_wanted_(spacings_wanted) {}

  void add(Side side, Stamp stamp);

  /// @return the sampling time [s], nothing until both streams have shown enough spacings.
  std::optional<double> period() const;

 private:
  std::size_t spacings_wanted_;
  std::array<std::optional<Stamp>, 2> last_;
  std::array<std::vector<Stamp>, 2> spacings_;
};

}  // namespace suspension_health_monitor
