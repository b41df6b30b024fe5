#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace suspension_health_monitor {

constexpr double square(double x) { return x * x; }

/// Chance of naming something without cause, before it is divided by the number of tests.
inline constexpr double kFalseAlarm = 0.001;

/// @return the middle value; of an even number the upper of the middle two, of none 0.
template <class Value>
Value median(std::vector<Value> values) {
  if (values.empty()) return Value{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// @return standard deviation of normally distributed errors about 0, by their median magnitude: outliers, as long as
/// they are fewer than half, change it little.
inline double robustDeviation(std::vector<double> errors) {
  constexpr double kSigmaPerMedian = 1.4826;  // 1 / (75 % quantile of the normal distribution)
  for (double& error : errors) error = std::abs(error);
  return kSigmaPerMedian * median(std::move(errors));
}

/// @return the value that a standard normal variable exceeds with this probability.
double normalQuantile(double probability);

}  // namespace suspension_health_monitor
