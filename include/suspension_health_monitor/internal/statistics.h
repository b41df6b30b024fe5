#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace suspension_health_monitor {

constexpr double square(double x) { return x * x; }

/// Chance of naming something without cause, before it is divided by the number of tests.
inline constexpr double kFalseAlarm = 0.001;

/// Standard deviations of what is certain of one vehicle, by chance once in a thousand, and of one drive of many, by
/// chance once in 16 000.
inline constexpr double kProven = 3.0, kCertain = 4.0;

/// Share of the measured signal that a model has to explain to be that of the strut.
inline constexpr double kLeastExplained = 0.5;

/// Relative standard deviation from which a number is not known: twice that would be the change that is an error.
inline constexpr double kMostRelativeStddev = 0.15;

/// Smallest relative change of a strut that matters: less is what another road does.
inline constexpr double kLeastChange = 0.03;

/// @return the middle value, in an order that it changes; of an even number the upper of the middle two, of none 0.
template <class Value>
Value medianInPlace(std::vector<Value>& values) {
  if (values.empty()) return Value{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Value>
Value median(std::vector<Value> values) {
  return medianInPlace(values);
}

/// @return the value that a standard normal variable exceeds with this probability.
double normalQuantile(double probability);

/// @return how many standard errors chance passes in none of `tests` two-sided tests, but with probability kFalseAlarm.
inline double limitFor(double tests) { return normalQuantile(0.5 * kFalseAlarm / tests); }

/// @return standard deviation of normally distributed errors about 0, by their median magnitude: outliers, as long as
/// they are fewer than half, change it little.
inline double robustDeviation(std::vector<double> errors) {
  for (double& error : errors) error = std::abs(error);
  return median(std::move(errors)) / normalQuantile(0.25);
}

}  // namespace suspension_health_monitor
