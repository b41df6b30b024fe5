#pragma once

namespace suspension_health_monitor {

/// Mean with exponential forgetting, sum lambda^(k-i) x_i / sum lambda^(k-i): unbiased from the first value on.
class RunningMean {
 public:
  /// @param forgetting_factor  lambda in (0, 1].
  explicit RunningMean(double forgetting_factor) : forgetting_factor_(forgetting_factor) {}

  void add(double value) {
    weight_ = forgetting_factor_ * weight_ + 1.0;
    mean_ += (value - mean_) / weight_;
  }

  double mean() const { return mean_; }      ///< 0 before the first value
  double weight() const { return weight_; }  ///< sum lambda^(k-i), at most 1 / (1 - lambda)

 private:
  double forgetting_factor_;
  double weight_ = 0.0;
  double mean_ = 0.0;
};

}  // namespace suspension_health_monitor
