#pragma once

#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

/// The newest samples of one signal, read by their age or in a row. Samples before the first push are 0.
/// A ring that is kept twice, one copy behind the other, so that the newest samples are in a row wherever it begins and
/// reading them takes no wrapping.
/// Cost per push: O(1), no allocation.
class DelayLine {
 public:
  /// @param length  number of samples kept, >= 1.
  explicit DelayLine(int length) : size_(length), samples_(2 * size_, 0.0), newest_(size_), missing_(size_) {}

  void push(double sample) {
    newest_ = newest_ + 1 == 2 * size_ ? size_ : newest_ + 1;
    samples_[newest_] = samples_[newest_ - size_] = sample;
    if (!full()) --missing_;
  }

  /// @param lag  age in samples, 0 (the newest) <= lag < length.
  /// @return q^-lag x.
  double at(int lag) const { return samples_[newest_ - lag]; }

  /// @return true once `length` samples have come.
  bool full() const { return missing_ == 0; }

  /// @return the `length` newest samples, the oldest first.
  const double* window() const { return &samples_[newest_ - size_ + 1]; }

  void reset() {
    samples_.assign(samples_.size(), 0.0);
    missing_ = size_;
  }

 private:
  std::size_t size_;
  std::vector<double> samples_;
  std::size_t newest_;   // in the copy behind
  std::size_t missing_;  // samples until it is full
};

}  // namespace suspension_health_monitor
