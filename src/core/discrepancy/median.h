#pragma once

#include <algorithm>
#include <vector>

namespace suspension_health_monitor {

/// Standard deviation of a normal variable over the median of its magnitude.
inline constexpr double kSigmaPerMedian = 1.4826;

/// @param values  at least one; of an even number the upper of the middle two.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace suspension_health_monitor
