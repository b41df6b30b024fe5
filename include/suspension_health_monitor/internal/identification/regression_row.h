#pragma once

#include <Eigen/Core>

namespace suspension_health_monitor {

/// One equation psi(k) = phi(k)' theta + e(k) of the regression (10).
struct RegressionRow {
  Eigen::VectorXd regressor;  ///< phi, one entry per parameter [unit of output / unit of parameter]
  double output = 0.0;        ///< psi

  /// @return true if no parameter can make a difference to this row.
  bool saysNothing() const { return regressor.isZero(0.0); }
};

}  // namespace suspension_health_monitor
