#pragma once

#include <array>
#include <cstddef>

namespace suspension_health_monitor {

/// Means of N quantities with exponential forgetting, sum lambda^(k-i) x_i / sum lambda^(k-i): unbiased from the first
/// value on.
template <std::size_t N>
class RunningMeans {
 public:
  /// @param forgetting_factor  lambda in (0, 1].
  explicit RunningMeans(double forgetting_factor) : forgetting_factor_(forgetting_factor) {}

  void add(const std::array<double, N>& values) {
    weight_ = forgetting_factor_ * weight_ + 1.0;
    const double gain = 1.0 / weight_;
    for (std::size_t i = 0; i < N; ++i) means_[i] += gain * (values[i] - means_[i]);
  }

  /// Of one quantity.
  void add(double value) { add(std::array<double, N>{value}); }

  /// From now on; what has been taken in keeps its weight.
  void setForgettingFactor(double forgetting_factor) { forgetting_factor_ = forgetting_factor; }

  double mean(std::size_t i = 0) const { return means_[i]; }  ///< 0 before the first values
  double weight() const { return weight_; }                   ///< sum lambda^(k-i), at most 1 / (1 - lambda)

 private:
  double forgetting_factor_;
  double weight_ = 0.0;
  std::array<double, N> means_{};
};

/// The mean of one quantity.
using RunningMean = RunningMeans<1>;

}  // namespace suspension_health_monitor
