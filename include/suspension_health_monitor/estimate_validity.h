#pragma once

#include <algorithm>

#include "suspension_health_monitor/identification/recursive_least_squares.h"

namespace suspension_health_monitor {

/// @return rows from which on an estimate may be valid: those wanted, or nine tenths of a memory that is shorter.
inline double fewestRows(int wanted, double forgetting_factor) {
  return std::min<double>(wanted, 0.9 / (1.0 - std::min(forgetting_factor, 1 - 1e-12)));
}

/// @return 1 - mean|epsilon| / mean|psi| over the memory of the estimator [-]; 0 as long as nothing has moved.
inline double explained(const RecursiveEstimator& estimator) {
  const double output = estimator.meanAbsoluteOutput();
  return output > 0.0 ? 1.0 - estimator.meanAbsoluteResidual() / output : 0.0;
}

/// Tells motion by the outputs of rows: without any noise there is none, but a sensor that is stuck or a vehicle at
/// rest.
class MotionJudge {
 public:
  /// @param most_silent_rows  so many outputs of 0 without a break are no motion, >= 1.
  explicit MotionJudge(int most_silent_rows) : most_(most_silent_rows) {}

  /// @return true if there is motion in this row.
  bool moves(double output) {
    silent_ = output == 0.0 ? std::min(silent_ + 1, most_) : 0;
    return silent_ < most_;
  }

 private:
  int most_;
  int silent_ = 0;  // counts up to most_ and stays there
};

}  // namespace suspension_health_monitor
