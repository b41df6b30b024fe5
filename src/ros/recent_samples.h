#pragma once

#include <algorithm>
#include <boost/circular_buffer.hpp>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"

namespace suspension_health_monitor {

/// The newest samples of a series, as many as fit. Not for two threads at a time.
/// Cost per push: O(1), no allocation, no lock.
/// @tparam Sample  has a stamp.
template <class Sample>
class Recent {
 public:
  /// @param capacity  number of samples kept, >= 1; their memory is taken here and now.
  explicit Recent(std::size_t capacity) : samples_(capacity, Sample{}) { clear(); }

  /// Takes in the next sample; one whose stamp is not after the last begins the series anew.
  void push(const Sample& sample) {
    if (!isNewer(sample)) clear();
    samples_.push_back(sample);
  }

  void clear() { samples_.clear(); }

  /// @return true if the sample is newer than all that is kept.
  bool isNewer(const Sample& sample) const { return samples_.empty() || sample.stamp > samples_.back().stamp; }

  /// @return the samples that are at most `span` older than the newest one, in the order of time.
  std::vector<Sample> newest(Stamp span) const {
    const auto is_old = [&](const Sample& sample) { return samples_.back().stamp - sample.stamp > span; };
    return {std::find_if_not(samples_.begin(), samples_.end(), is_old), samples_.end()};
  }

 private:
  boost::circular_buffer<Sample> samples_;
};

}  // namespace suspension_health_monitor
