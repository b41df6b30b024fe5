#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace suspension_health_monitor {

/// Derivative of a uniformly sampled series: the slope, in the middle, of the cubic that fits 2 m + 1 samples best
/// (least squares). Exact for polynomials of degree 4; white noise of standard deviation s comes out as s noiseGain().
class SlopeFilter {
 public:
  static constexpr int kWidest = 12;

  /// @param half_width  m in [2, kWidest].  @param period  T > 0 [s].
  SlopeFilter(int half_width, double period);

  /// @return of m = 2, 4, 8, 12 the narrowest with which noise is less than a thousandth of the slope's mean square.
  /// The noise is what the fourth differences show: nothing that a series is worth sampling for has such.
  /// @param series  each with kWidest samples on either side of where slopes are wanted.
  static SlopeFilter fitting(const std::vector<std::vector<double>>& series, double period);

  /// @param middle  with m samples before and behind it.
  double operator()(const double* middle) const;

  int halfWidth() const { return static_cast<int>(weights_.size()); }
  double noiseGain() const { return std::sqrt(2.0) * weights_.norm(); }

 private:
  Eigen::VectorXd weights_;  // of x[k] - x[-k], k = 1 .. m
};

}  // namespace suspension_health_monitor
