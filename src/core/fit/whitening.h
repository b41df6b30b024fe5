#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

/// Order: two for each resonance of body and wheel, and for sensors' filters.
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

/// @param counts  1 where a whitened sample counts, else 0.  @param accuracy  below which no error is [m/s^2].
/// @return one over the variance; less for outliers; 0 for what does not count.
inline Eigen::VectorXd robustWeights(const Eigen::VectorXd& white, const Eigen::VectorXd& counts, double accuracy) {
  std::vector<double> counted;
  for (Eigen::Index k = 0; k < white.size(); ++k)
    if (counts[k] > 0.0) counted.push_back(white[k]);
  const double limit = kOutlierScale * std::max(robustDeviation(counted), accuracy);
  const Eigen::VectorXd weights = counts.array() / (1.0 + (white.array() / limit).square()).sqrt();
  const double variance = weights.dot(white.cwiseAbs2()) / weights.sum();
  return weights / std::max(variance, square(accuracy));
}

/// Sum of the squared scores of stretches: it tells the scatter of a solution where noise is not alike at all times.
/// @param weighted  what the solution leaves, weighted.  @param length  of a stretch.
inline Eigen::MatrixXd sumOfScores(const Eigen::MatrixXd& columns, const Eigen::VectorXd& weighted,
                                   Eigen::Index length) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  for (Eigen::Index k = 0; k < columns.rows(); k += length) {
    const Eigen::Index count = std::min(length, columns.rows() - k);
    const Eigen::VectorXd score = columns.middleRows(k, count).transpose() * weighted.segment(k, count);
    sum.noalias() += score * score.transpose();
  }
  return sum;
}

}  // namespace suspension_health_monitor
