#pragma once

#include <random>
#include <vector>

#include "suspension_health_monitor/internal/identification/regression.h"

namespace suspension_health_monitor {

inline Eigen::VectorXd vectorOf(const std::vector<double>& entries) {
  return Eigen::Map<const Eigen::VectorXd>(entries.data(), static_cast<Eigen::Index>(entries.size()));
}

/// Rows psi = phi' theta + noise with independent normal regressors.
/// @param noise  standard deviation of the normal noise on psi.
inline std::vector<RegressionRow> randomRows(const Eigen::VectorXd& theta, int count, double noise, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<RegressionRow> rows;
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd regressor(theta.size());
    for (double& entry : regressor) entry = normal(engine);
    const double clean = regressor.dot(theta);
    rows.push_back({regressor, clean + noise * normal(engine)});
  }
  return rows;
}

}  // namespace suspension_health_monitor
