#pragma once

#include <optional>

#include "suspension_health_monitor/internal/identification/horizon_mean.h"
#include "suspension_health_monitor/internal/identification/regressor_noise.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// How much noise the sensors have, from what a model leaves of the rows.
///
/// White noise of the sensors is in every band of the residual by the filters' responses (RegressorNoise). What else a
/// model leaves is not: an engine shakes fast, an offset drifts slowly. So the noise is measured in two bands, the
/// residual's change from row to row and its mean over a horizon, and is no more than the lesser of the two. Both are
/// means of the size, in which no row counts for more than kMostSizes of them: single wrong readings are no noise.
/// Noise of low frequencies is that which least squares takes for motion: what they leave of it is less.
/// Cost per row: O(1), no allocation.
class NoiseLevel {
 public:
  explicit NoiseLevel(const IntegralFilterOptions& filter);

  /// @return rows within which the sensors' noise in them is correlated.
  static double blockRows(const IntegralFilterOptions& filter) { return 2.0 * filter.horizon_samples; }

  /// @param residual  of the next row of an uninterrupted series.
  void add(double residual);

  void interrupt() { in_series_ = 0; }

  /// Variances of a sensor by what the residuals have of its noise in either band [(m/s^2)^2].
  struct Variances {
    double of_changes, of_means;
    double of_late_means;  ///< over kFewestBlocks, without a limit
  };

  /// @param theta  the strut (b1 [1/s], b0 [1/s^2]).
  /// @return empty before kFewestBlocks blocks of rows.
  std::optional<Variances> sensorVariances(const RegressorNoise& noise, const Eigen::Vector2d& theta) const;

 private:
  static constexpr double kMostSizes = 5.0;
  static constexpr double kFewestBlocks = 5.0, kMostBlocks = 100.0;

  double block_;  // rows
  RunningMeans<2> sizes_;
  RunningMean late_mean_size_;
  HorizonMean mean_;
  double last_ = 0.0;  // residual
  int in_series_ = 0;  // rows
};

}  // namespace suspension_health_monitor
