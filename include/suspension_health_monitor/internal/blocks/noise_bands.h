#pragma once

#include <vector>

#include "suspension_health_monitor/internal/blocks/block_options.h"

namespace suspension_health_monitor {

/// Bands of neighbouring bins within which the power of what is unexplained counts as equal. A band of n bins of one
/// block has n complex values, so that its power is known to 1 / sqrt(n); the widths grow with frequency as resonances
/// do.
class NoiseBands {
 public:
  static constexpr int kFewestBins = 5;
  static constexpr int kMost = (BlockBand::kLast - BlockBand::kFirst + 1) / kFewestBins;
  static constexpr double kRatio = 1.25;  ///< upper over lower end: a third of an octave

  explicit NoiseBands(const BlockBand& band) {
    int from = 0;
    const auto nextEdge = [&](int at) {
      const double end = kRatio * (band.first + at);
      int by_ratio = at;
      while (band.first + by_ratio < end) ++by_ratio;
      return at + kFewestBins > by_ratio ? at + kFewestBins : by_ratio;
    };
    while (from < band.size()) {
      int to = nextEdge(from);
      if (to > band.size() || band.size() - to < kFewestBins) to = band.size();
      first_.push_back(from);
      size_.push_back(to - from);
      from = to;
    }
  }

  int count() const { return static_cast<int>(first_.size()); }
  int first(int band) const { return first_[static_cast<std::size_t>(band)]; }  ///< bin, counted from the lowest used
  int size(int band) const { return size_[static_cast<std::size_t>(band)]; }

 private:
  std::vector<int> first_, size_;
};

}  // namespace suspension_health_monitor
