#pragma once

#include <cstddef>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/identification/running_mean.h"

namespace suspension_health_monitor {

/// Whether something else than the wheel moves the body: wind, people who get in or load, an engine.
///
/// The regression does not see that: any motion of one frequency over a wheel that stands, or follows the body on its
/// tyre, looks like a strut without damping, b0 = omega^2. But the wheel then moves little. So a force from outside is
/// suspected
/// - while the wheel's acceleration is less than a tenth of what it was while the estimates were good, and the body's
///   more than sqrt(2) times the wheel's;
/// - as long as they never were: while the body's is more than three times the wheel's.
/// Cost per sample looked at: O(1), no allocation. Free of units.
class OutsideForce {
 public:
  /// @param memory  of the estimates, in samples looked at; it looks at half of that, to be the first to know.
  explicit OutsideForce(double memory) : means_(1.0) { setMemory(memory); }

  /// From now on; what has been looked at keeps its weight.
  void setMemory(double memory);

  /// @param valid  the estimates are, as the wheel moves now.
  void look(const CornerSample& sample, bool valid);

  bool isSuspected() const { return suspected_; }

 private:
  enum Mean : std::size_t { kBody, kSquareBody, kWheel, kSquareWheel, kNumMeans };

  static constexpr double kUsualKept = 0.999;  // of the usual, per look

  double variance(Mean value, Mean square) const;

  RunningMeans<kNumMeans> means_;
  RunningMean usual_wheel_{kUsualKept};  // variance
  bool suspected_ = false;
};

}  // namespace suspension_health_monitor
