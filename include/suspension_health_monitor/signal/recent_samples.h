#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"

namespace suspension_health_monitor {

/// The newest samples of a series, as many as fit. Not for two threads at a time.
/// Cost per push: O(1), no allocation, no lock.
class RecentSamples {
 public:
  /// @param capacity  number of samples kept, >= 1; their memory is taken here and now.
  explicit RecentSamples(std::size_t capacity) : ring_(capacity) {}

  /// Takes in the next sample; one whose stamp is not after the last begins the series anew.
  void push(const CornerSample& sample) {
    if (size_ > 0 && sample.stamp <= ring_[newest_].stamp) size_ = 0;
    newest_ = newest_ + 1 == ring_.size() ? 0 : newest_ + 1;
    ring_[newest_] = sample;
    size_ = std::min(size_ + 1, ring_.size());
  }

  std::size_t size() const { return size_; }

  /// @return the samples that are at most `span` older than the newest one, in the order of time.
  std::vector<CornerSample> newest(Stamp span) const {
    std::vector<CornerSample> samples;
    samples.reserve(size_);
    for (std::size_t age = size_; age-- > 0;) {
      const CornerSample& sample = ring_[(newest_ + ring_.size() - age) % ring_.size()];
      if (ring_[newest_].stamp - sample.stamp <= span) samples.push_back(sample);
    }
    return samples;
  }

 private:
  std::vector<CornerSample> ring_;
  std::size_t newest_ = 0;
  std::size_t size_ = 0;
};

}  // namespace suspension_health_monitor
