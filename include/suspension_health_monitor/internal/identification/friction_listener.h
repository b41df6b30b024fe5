#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Dry friction in what the linear strut leaves of the rows: a force f sgn(v) has the column c = I_2^2 sgn(v) beside
/// phi, so that f = E[c e] / E[c (c - phi'g)], all less their means, e what least squares leaves, g = R^-1 E[phi c]
/// what a unit of f makes of b1 and b0 (the partialled regression of Frisch, Waugh and Lovell). The travel's rate v is
/// u = w'' - z'' integrated, without what is slower than the horizon: of friction only its sign counts, and the time
/// when that changes. A damper that is softer the faster it moves has an f, too; one that is harder has one below 0.
/// Cost per sample: O(1), no allocation.
class FrictionListener {
 public:
  /// @param delay  of rows behind the sample that completes them [samples].
  FrictionListener(const IntegralFilterOptions& filter, int delay, double forgetting_factor);

  /// Takes in the next sample of an uninterrupted series.  @param relative  u [m/s^2].
  void addSample(double relative);

  /// Takes in the row that the newest sample has completed.
  /// @param innovation  of `estimator` by it, in the unit of psi.
  void addRow(const RegressionRow& row, double innovation, const RecursiveEstimator& estimator);

  /// The next sample does not follow the one before.
  void interrupt();

  void setForgettingFactor(double forgetting_factor);

  /// @param least_squares  of these rows.
  /// @return what is known; empty before there are rows.
  std::optional<DryFriction> friction(const RecursiveLeastSquares& least_squares) const;

 private:
  enum Column : std::size_t { kSign, kDamping, kStiffness, kNumColumns };
  enum Moment : std::size_t { kSignDamping, kSignStiffness, kSignOutput, kSignSquare, kNumMoments };

  double period_, leak_;  // [s], [1/s]
  int delay_;
  bool has_sample_ = false;  // in this series
  double newest_ = 0.0;      // u of the newest sample
  double integral_ = 0.0;    // of u, leaky [m/s]
  double slow_ = 0.0;        // part of it [m/s]
  LinearIntegralFilter sign_;
  DelayLine column_;
  RunningMeans<kNumColumns> means_;
  RunningMeans<kNumMoments> moments_;  // of what is left without the means, which are the offset's
};

}  // namespace suspension_health_monitor
