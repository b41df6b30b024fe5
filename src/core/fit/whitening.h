#pragma once

#include <Eigen/Core>
#include <limits>

#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

/// Order of the filter: two for each resonance of body and wheel, and for filters of the sensors.
inline constexpr Eigen::Index kWhitening = 10;

/// A series behind an FIR filter that begins where it has its past; 0 before.
/// @param taps  the newest sample's last.
inline Eigen::VectorXd filtered(const Eigen::VectorXd& series, const Eigen::VectorXd& taps) {
  const Eigen::Index n = series.size() - taps.size() + 1;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(series.size());
  for (Eigen::Index j = 0; j < taps.size(); ++j) result.tail(n) += taps[j] * series.segment(j, n);
  return result;
}

/// Prediction error filter of an autoregressive model of a series, by least squares.
/// @param counts  1 where a sample and those before it are of one stretch, else 0.
inline Eigen::VectorXd whiteningOf(const Eigen::VectorXd& series, const Eigen::VectorXd& counts) {
  const Eigen::Index n = series.size() - kWhitening;
  Eigen::MatrixXd past(n, kWhitening);
  for (Eigen::Index j = 0; j < kWhitening; ++j) past.col(j) = counts.tail(n).cwiseProduct(series.segment(j, n));
  Eigen::MatrixXd normal = past.transpose() * past;
  normal.diagonal().array() += kRounding * normal.trace() + std::numeric_limits<double>::min();
  Eigen::VectorXd taps(kWhitening + 1);
  taps << -solveSymmetric(normal, past.transpose() * series.tail(n)), 1.0;
  return taps;
}

}  // namespace suspension_health_monitor
