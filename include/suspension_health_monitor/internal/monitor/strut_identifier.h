#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/excitation.h"
#include "suspension_health_monitor/internal/identification/friction_listener.h"
#include "suspension_health_monitor/internal/identification/paired_estimators.h"
#include "suspension_health_monitor/internal/identification/synchronous_regression.h"
#include "suspension_health_monitor/internal/monitor/error_budget.h"
#include "suspension_health_monitor/internal/monitor/silent_rows.h"
#include "suspension_health_monitor/internal/monitor/validity_gate.h"
#include "suspension_health_monitor/internal/monitor_settings.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// The estimation itself, step by step: regression rows of a series of samples, what they tell of the strut
/// (Excitation), LS and LA of them side by side (PairedEstimators), and what these are off by beyond the scatter of
/// rows (ErrorBudget). Rows that tell nothing are only observed, so that the estimates stay. Whether an estimate may be
/// trusted is decided elsewhere, by facts(). Cost per sample: O(1) whatever the horizon; no allocation.
class StrutIdentifier {
 public:
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  explicit StrutIdentifier(const MonitorSettings& options);

  /// Goes on with other effects: one column for each beside b1 and b0. Allocates.
  /// @param effects  where their coefficients come from; numbers before the change count from the first effect.
  void changeEffects(const std::vector<ColumnOrigin>& effects);

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @param effect_forces  f_j at this sample, one per effect.
  void add(const CornerSample& sample, const double* effect_forces);

  /// No row comes of the newest sample.
  void skip() { has_row_ = false; }

  /// Writes what is known now, all but the doubt.
  void describe(StrutEstimate& ls, StrutEstimate& la);

  /// @param estimate  as described, of either estimator.
  EstimateFacts facts(const StrutEstimate& estimate) const;

  /// What is learned of the strut and of the estimates' scatter is learned while they are valid.
  void noteValidity(const StrutEstimate& ls, const StrutEstimate& la);

  bool hasRow() const { return has_row_; }  ///< of the newest sample

  const SynchronousRegression& regression() const { return regression_; }
  const ErrorBudget& errors() const { return errors_; }

  /// @return true while rows tell nothing of the strut, and are only observed.
  bool holdsAll() const;

  void startNewSeries();

  /// Another drive begins, perhaps of another vehicle: nothing is held any more.
  void startNewDrive();

  /// The estimates begin anew with the next row to be worth something, since the model has changed.
  void restartValidity() { rows_ = 0.0; }

  /// From the next row on; the estimates stay.
  /// @param options  of which memory, fastest_memory and forgetting_factor count.
  /// @throws std::invalid_argument  as RecursiveOptions::validate().
  void setForgetting(const MonitorSettings& options);

  /// @param stddevs  of (b1 [1/s], b0 [1/s^2]) by what the samples went through before: no row shows that.
  void setInputStddevs(const Eigen::Vector2d& stddevs) { errors_.setInputStddevs(stddevs); }

  /// What the samples are wrong by because they were resampled.
  void setResamplingErrors(const ResamplingErrors& errors) { errors_.setResamplingErrors(errors); }

  /// As ErrorBudget::setWheelSpectrum().
  void setWheelSpectrum(double folded, double at_limit) { errors_.setWheelSpectrum(folded, at_limit); }

  /// @return the factor that rows are forgotten by now.
  double forgettingFactor() const { return estimators_.forgettingFactor(); }

  /// @return c_j of LA [unit of the effect's coefficient].
  double coefficient(std::size_t j) const {
    return estimators_.leastAbsolute().parameters()[kNumStrutParameters + static_cast<Eigen::Index>(j)];
  }

 private:
  void update(const RegressionRow& row);
  void takeExcitation();
  bool isHeld(StrutParameter i) const { return !forgets_unexcited_ && !excitation_.excited(i); }

  IntegralFilterOptions filter_;
  bool forgets_unexcited_;  // false: parameters of which the rows tell nothing are held
  Excitation excitation_;
  SynchronousRegression regression_;
  PairedEstimators estimators_;
  ErrorBudget errors_;
  FrictionListener friction_;
  SilentRows silent_rows_;
  bool has_row_ = false;
  double rows_;                  // of the model's present columns
  double fewest_rows_ = 0.0;     // of a valid estimate
  double rows_to_forget_ = 0.0;  // until what a force from outside did is forgotten
};

}  // namespace suspension_health_monitor
