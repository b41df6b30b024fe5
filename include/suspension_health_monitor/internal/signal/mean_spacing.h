#pragma once

#include <algorithm>
#include <cstddef>

#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

/// Mean spacing of the samples of uninterrupted series, over the newest kMemory of them: of many at once, so that a
/// sample costs nothing.
class MeanSpacing {
 public:
  /// A series begins with the sample of this stamp.
  void begin(Stamp stamp) {
    counted_until_ = stamp;
    counted_ = 1;
  }

  /// @param stamp  of the newest sample of the series that began last.  @param samples  of that series so far, >= 1.
  void countUntil(Stamp stamp, std::size_t samples) {
    if (samples <= counted_) return;
    const double spacings = static_cast<double>(samples - counted_);
    weight_ = std::max(spacings, std::min(weight_ + spacings, kMemory));
    mean_ += (toSeconds(stamp - counted_until_) - spacings * mean_) / weight_;
    counted_until_ = stamp;
    counted_ = samples;
  }

  double mean() const { return mean_; }      ///< [s]; 0 before the first spacing
  double weight() const { return weight_; }  ///< number of spacings in the mean

 private:
  static constexpr double kMemory = 500.0;

  Stamp counted_until_{};
  std::size_t counted_ = 0;  // samples of the series
  double mean_ = 0.0, weight_ = 0.0;
};

}  // namespace suspension_health_monitor
