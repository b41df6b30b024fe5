#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

/// The newest samples of a series, as many as fit. Not for two threads at a time.
/// Cost per push: O(1), no allocation, no lock.
/// @tparam Sample  has a stamp.
template <class Sample>
class Recent {
 public:
  /// @param capacity  number of samples kept, >= 1; their memory is taken here and now.
  explicit Recent(std::size_t capacity) : ring_(capacity) {}

  /// Takes in the next sample; one whose stamp is not after the last begins the series anew.
  void push(const Sample& sample) {
    if (!isNewer(sample)) clear();
    newest_ = newest_ + 1 == ring_.size() ? 0 : newest_ + 1;
    ring_[newest_] = sample;
    size_ = std::min(size_ + 1, ring_.size());
  }

  void clear() { size_ = 0; }

  std::size_t size() const { return size_; }

  /// @return true if the sample is newer than all that is kept.
  bool isNewer(const Sample& sample) const { return size_ == 0 || sample.stamp > ring_[newest_].stamp; }

  /// @return the samples that are at most `span` older than the newest one, in the order of time.
  std::vector<Sample> newest(Stamp span) const {
    std::vector<Sample> samples;
    samples.reserve(size_);
    for (std::size_t age = size_; age-- > 0;) {
      const Sample& sample = ring_[(newest_ + ring_.size() - age) % ring_.size()];
      if (ring_[newest_].stamp - sample.stamp <= span) samples.push_back(sample);
    }
    return samples;
  }

 private:
  std::vector<Sample> ring_;
  std::size_t newest_ = 0;
  std::size_t size_ = 0;
};

using RecentSamples = Recent<CornerSample>;

}  // namespace suspension_health_monitor
