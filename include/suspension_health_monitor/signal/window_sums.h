#pragma once

#include <array>

namespace suspension_health_monitor {

/// What the weights and the value of a StreamResampler need of the readings in its window.
class WindowSums {
 public:
  static constexpr int kHalfWidth = 8;  ///< [grid periods]

  /// @param tau  time from the instant asked for [grid periods], |tau| <= kHalfWidth.
  /// @param spacing  q, half the time between the neighbours [grid periods].
  /// @param value  of the reading.
  void add(double tau, double spacing, double value);

  /// @return sum_i w_i x_i; at least one reading must lie inside the window.
  double value() const;

 private:
  static constexpr int kLines = 6;  // above frequency 0

  std::array<double, 2 * kLines + 1> cosine_{}, sine_{};                // sum of g cos(m theta tau), ... sin
  std::array<double, kLines + 1> filter_cosine_{}, filter_sine_{};      // of q h cos(k theta tau)
  std::array<double, kLines + 1> weighted_cosine_{}, weighted_sine_{};  // of g x cos(k theta tau)
  double filtered_ = 0.0;                                               // of q h x
};

}  // namespace suspension_health_monitor
