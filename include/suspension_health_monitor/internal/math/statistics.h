#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

constexpr double square(double x) { return x * x; }

/// Chance of naming something without cause, before it is divided by the number of tests.
inline constexpr double kFalseAlarm = 0.001;

/// Standard deviations of what is likely, by chance once in 22; of what is certain of one vehicle, by chance once in a
/// thousand; and of one drive of many, by chance once in 16 000.
inline constexpr double kLikely = 2.0, kProven = 3.0, kCertain = 4.0;

/// The greater part of a quantity: of the signal that a model explains, of an error that a law takes, of a power.
inline constexpr double kMajority = 0.5;

/// Small against another quantity of its kind: of squares, which add up, a hundredth.
inline constexpr double kSmall = 0.1;

/// Smallest share of an error, or of what the struts do, that is worth a name.
inline constexpr double kWorthHaving = 0.02;

/// A number and its standard deviation.
struct Measured {
  double value = 0.0;
  double stddev = 0.0;  ///< NaN: not known

  bool isKnown() const { return std::abs(value) > kLikely * stddev; }  ///< it is not by chance
  double most() const { return std::abs(value) + kLikely * stddev; }   ///< magnitude that it is likely to be below
};

/// Relative difference of rounded numbers that would be equal.
inline constexpr double kRounding = 1e-9;

/// Relative step of numerical derivatives: between rounding and curvature.
inline constexpr double kDifferenceStep = 1e-6;

/// Times as large: clearly larger, by no choice of the data; and much larger, by no tolerance of a sensor or a law.
inline constexpr double kClearlyMore = 2.0, kMuchMore = 3.0;

/// Fewest values that tell their own scatter: to a quarter.
inline constexpr std::size_t kFewestForScatter = 8;

/// Relative difference of b1, of b0 or of the gains of two sensors that counts. Links and the wheel's turning make up
/// to 2 % on recorded multibody vehicles.
inline constexpr double kLeastDifference = 0.05;

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
