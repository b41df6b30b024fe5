#pragma once

#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

/// The newest samples of one signal, read by their age. Samples before the first push are 0.
/// Cost per push: O(1), no allocation.
class DelayLine {
 public:
  /// @param length  number of samples kept, >= 1.
  explicit DelayLine(int length) : samples_(static_cast<std::size_t>(length), 0.0) {}

  void push(double sample) {
    newest_ = newest_ + 1 == samples_.size() ? 0 : newest_ + 1;
    samples_[newest_] = sample;
  }

  /// @param lag  age in samples, 0 (the newest) <= lag < length.
  /// @return q^-lag x.
  double at(int lag) const {
    const auto age = static_cast<std::size_t>(lag);
    return samples_[age <= newest_ ? newest_ - age : newest_ + samples_.size() - age];
  }

  void reset() { samples_.assign(samples_.size(), 0.0); }

 private:
  std::vector<double> samples_;
  std::size_t newest_ = 0;
};

}  // namespace suspension_health_monitor
