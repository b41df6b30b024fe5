#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"
#include "suspension_health_monitor/internal/identification/variable_forgetting.h"

namespace suspension_health_monitor {

/// LS and LA of the same rows of a strut, side by side: they have the same columns, hold the same parameters and forget
/// by the same factor, and LS tells whether LA is lost. Columns are b1, b0, those of the effects, those of the sensors.
/// Cost per row: O(p^2) for p columns, no allocation.
class PairedEstimators {
 public:
  /// Of the plain strut.
  /// @param recursive  of both, by one factor always; with correlated_rows given.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  PairedEstimators(SensorColumns sensors, const RecursiveOptions& recursive,
                   const LeastAbsoluteOptions& least_absolute);

  /// Goes on with other effects; nothing is held until hold(). Allocates.
  /// @param effects  where their coefficients come from; numbers before the change count from the first effect.
  /// @return where all columns come from.
  std::vector<ColumnOrigin> changeEffects(const std::vector<ColumnOrigin>& effects);

  /// @return the innovation of LA before the update, in the unit of psi.
  double update(const RegressionRow& row);

  /// As RecursiveEstimator::observe().
  void observe(const RegressionRow& row);

  /// Holds b1, b0 from the next row on, or no longer (RecursiveEstimator::hold()); with either what is estimated of the
  /// sensors is held, too.
  void hold(bool damping, bool stiffness);

  /// The next row does not follow the one before.
  void interrupt();

  /// To be called for every row: the estimates' scatter is learned while they are valid, and only a valid estimate can
  /// be seen to move.
  void noteValidity(bool ls_is_valid, bool la_is_valid);

  /// From the next row on; the estimates stay.
  /// @param slow  forgetting factor while the parameters stay.
  /// @param fastest  while they move (VariableForgetting), at most `slow`; none: `slow` always.
  /// @throws std::invalid_argument  as RecursiveOptions::validate().
  void setForgetting(double slow, const std::optional<double>& fastest);

  /// @return the factor that rows are forgotten by now.
  double forgettingFactor() const { return least_absolute_.forgettingFactor(); }

  const RecursiveLeastSquares& leastSquares() const { return least_squares_; }
  const RecursiveLeastAbsolute& leastAbsolute() const { return least_absolute_; }

  /// @return how many columns are those of the strut and of its effects: all but the sensors', which are the last.
  int numModelColumns() const { return least_absolute_.numParameters() - num_sensors_; }

  /// @return psi of the row without what effects make of it, by LA. The offset between the sensors is no part of psi,
  /// but of the regressor of the stiffness, which Excitation knows.
  double withoutEffects(const RegressionRow& row) const;

 private:
  void forgetBy(double factor);

  int num_sensors_;      // columns of theirs
  int correlated_rows_;  // 2 L
  RecursiveLeastSquares least_squares_;
  RecursiveLeastAbsolute least_absolute_;
  std::optional<VariableForgetting> variable_forgetting_;  // none: by one factor always
  double lost_memories_ = 0.0;                             // that LS has explained far more than LA for
  bool la_is_valid_ = false;
};

}  // namespace suspension_health_monitor
