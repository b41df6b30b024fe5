#pragma once

#include <optional>

#include "suspension_health_monitor/internal/identification/horizon_integral.h"
#include "suspension_health_monitor/internal/identification/regressor_noise.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// How much noise the sensors have, from what a model leaves of the rows.
///
/// White noise of the sensors is in every band of the residual by the filters' responses (RegressorNoise). What else a
/// model leaves is not: an engine shakes fast, an offset drifts slowly. So the noise is measured in two bands, the
/// residual's change from row to row and its mean over a horizon, and is no more than the lesser of the two. Both are
/// means of the size, in which no row counts for more than kMostSizes of them: single wrong readings are no noise.
/// Cost per row: O(1), no allocation.
class NoiseLevel {
 public:
  explicit NoiseLevel(const IntegralFilterOptions& filter);

  /// @param residual  of the next row of an uninterrupted series.
  void add(double residual);

  void interrupt() { in_series_ = 0; }

  /// @param theta  the strut (b1 [1/s], b0 [1/s^2]).
  /// @param fitted  variance of the noise by what the residuals of least squares show of it, at low frequencies, where
  /// the noise is that it takes for motion.
  /// @return variance of a sensor [(m/s^2)^2]; empty before kFewestBlocks blocks of rows.
  std::optional<double> sensorVariance(const RegressorNoise& noise, const Eigen::Vector2d& theta, double fitted) const;

 private:
  static constexpr double kMostSizes = 5.0;
  static constexpr double kFewestBlocks = 5.0, kMostBlocks = 100.0;  // of two horizons, in which rows are correlated

  double block_;  // [rows]
  int horizon_;   // [rows]
  RunningMeans<2> sizes_;
  HorizonIntegral mean_;
  DelayLine residuals_;
  int in_series_ = 0;  // rows
};

}  // namespace suspension_health_monitor
