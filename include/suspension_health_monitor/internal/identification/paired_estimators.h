#pragma once

#include <vector>

#include "suspension_health_monitor/internal/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"

namespace suspension_health_monitor {

/// LS and LA of the same rows of a strut, side by side: they have the same columns and forget by the same factor, and
/// LS tells whether LA is lost. Columns are b1, b0, those of the effects, those of the sensors. Cost per row: O(p^2)
/// for p columns, no allocation.
class PairedEstimators {
 public:
  /// Of the plain strut.
  /// @param recursive  of both, by one factor always; with correlated_rows given.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  PairedEstimators(SensorColumns sensors, const RecursiveOptions& recursive,
                   const LeastAbsoluteOptions& least_absolute);

  /// Goes on with other effects. Allocates.
  /// @param effects  where their coefficients come from; numbers before the change count from the first effect.
  /// @return where all columns come from.
  std::vector<ColumnOrigin> changeEffects(const std::vector<ColumnOrigin>& effects);

  void update(const RegressionRow& row);

  /// As RecursiveEstimator::observe().
  void observe(const RegressionRow& row);

  /// The next row does not follow the one before.
  void interrupt();

  /// From the next row on; the estimates stay.
  /// @throws std::invalid_argument  as RecursiveOptions::validate().
  void setForgettingFactor(double forgetting_factor);

  double forgettingFactor() const { return least_absolute_.forgettingFactor(); }

  const RecursiveLeastSquares& leastSquares() const { return least_squares_; }
  const RecursiveLeastAbsolute& leastAbsolute() const { return least_absolute_; }

  /// @return how many columns are those of the strut and of its effects: all but the sensors', which are the last.
  int numModelColumns() const { return least_absolute_.numParameters() - num_sensors_; }

 private:
  int num_sensors_;  // columns of theirs
  RecursiveLeastSquares least_squares_;
  RecursiveLeastAbsolute least_absolute_;
  double lost_memories_ = 0.0;  // that LS has explained far more than LA for
};

}  // namespace suspension_health_monitor
