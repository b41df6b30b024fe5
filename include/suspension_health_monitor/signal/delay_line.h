#pragma once

#include <cstddef>
#include <vector>

#include "suspension_health_monitor/signal/ring_size.h"

namespace suspension_health_monitor {

/// The newest samples of one signal, read by their age. Samples before the first push are 0.
/// Cost per push: O(1), no allocation.
class DelayLine {
 public:
  /// @param length  number of samples kept at least, >= 1.
  explicit DelayLine(int length)
      : samples_(ringSize(static_cast<std::size_t>(length)), 0.0), mask_(samples_.size() - 1) {}

  void push(double sample) {
    newest_ = (newest_ + 1) & mask_;
    samples_[newest_] = sample;
  }

  /// @param lag  age in samples, 0 (the newest) <= lag < length.
  /// @return q^-lag x.
  double at(int lag) const { return samples_[(newest_ - static_cast<std::size_t>(lag)) & mask_]; }

  void reset() { samples_.assign(samples_.size(), 0.0); }

 private:
  std::vector<double> samples_;
  std::size_t mask_;
  std::size_t newest_ = 0;
};

}  // namespace suspension_health_monitor
