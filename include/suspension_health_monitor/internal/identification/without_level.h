#pragma once

#include <array>
#include <cstddef>

#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// N quantities without what they are on average over the last values, twice: of one that drifts steadily nothing is
/// left. All go through the same, so that what is linear in them stays so.
template <std::size_t N>
class WithoutLevel {
 public:
  /// @param memory  of the mean, above 1 [values].
  explicit WithoutLevel(double memory) : first_(1.0 - 1.0 / memory), second_(first_) {}

  std::array<double, N> push(std::array<double, N> values) {
    for (RunningMeans<N>* level : {&first_, &second_}) {
      level->add(values);
      for (std::size_t i = 0; i < N; ++i) values[i] -= level->mean(i);
    }
    return values;
  }

 private:
  RunningMeans<N> first_, second_;
};

}  // namespace suspension_health_monitor
