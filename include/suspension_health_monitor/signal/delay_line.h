#pragma once

#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

/// The newest samples of one signal, read by their age. Samples before the first push are 0.
/// Cost per push: O(1), no allocation.
class DelayLine {
 public:
  /// @param length  number of samples kept at least, >= 1.
  explicit DelayLine(int length)
      : samples_(roundUp(static_cast<std::size_t>(length)), 0.0), mask_(samples_.size() - 1) {}

  void push(double sample) {
    newest_ = (newest_ + 1) & mask_;
    samples_[newest_] = sample;
  }

  /// @param lag  age in samples, 0 (the newest) <= lag < length.
  /// @return q^-lag x.
  double at(int lag) const { return samples_[(newest_ - static_cast<std::size_t>(lag)) & mask_]; }

  void reset() { samples_.assign(samples_.size(), 0.0); }

 private:
  // A power of two, so that an index wraps by a mask.
  static std::size_t roundUp(std::size_t length) {
    std::size_t size = 1;
    while (size < length) size *= 2;
    return size;
  }

  std::vector<double> samples_;
  std::size_t mask_;
  std::size_t newest_ = 0;
};

}  // namespace suspension_health_monitor
