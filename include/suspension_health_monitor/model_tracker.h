#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/discrepancy/running_comparison.h"
#include "suspension_health_monitor/estimate_validity.h"
#include "suspension_health_monitor/health/outside_force.h"
#include "suspension_health_monitor/identification/excitation.h"
#include "suspension_health_monitor/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/identification/recursive_least_squares.h"
#include "suspension_health_monitor/identification/regressor_noise.h"
#include "suspension_health_monitor/identification/suspension_regression.h"
#include "suspension_health_monitor/identification/variable_forgetting.h"
#include "suspension_health_monitor/model/free_run.h"
#include "suspension_health_monitor/monitor_options.h"
#include "suspension_health_monitor/strut_estimate.h"

namespace suspension_health_monitor {

/// The model, driven by the measured wheel acceleration, against the measured body acceleration at one sample.
struct ComparisonReport {
  bool has_sample = false;          ///< false at the first FreeRun::kDelay samples of a series: the rest then holds
  Stamp stamp{};                    ///< of the compared sample, FreeRun::kDelay before the newest
  double measured = std::nan("");   ///< z'' [m/s^2]
  std::optional<double> predicted;  ///< by the free run with LA's parameters [m/s^2]; empty until it has settled
  double rmse = std::nan("");       ///< over the window [m/s^2]; renewed every few samples, as what follows
  double fit_percent = std::nan("");
  double base_rmse = std::nan("");  ///< the same of the model without effects
  double base_fit_percent = std::nan("");
};

/// What is known of one model after one sample.
struct ModelReport {
  bool has_row = false;  ///< the sample gave a regression row; false while the filter fills: the estimates then hold
  StrutEstimate ls, la;
  ComparisonReport comparison;
};

/// One model of the strut, plain or with effects, followed through a drive: free run, regression rows, LS and LA, and
/// how well the free run with LA's parameters predicts.
///
/// Rows of the plain model are those of the newest sample. The columns of effects need travel and travel rate, which
/// the free run tells FreeRun::kDelay samples late; so does a model with effects give its rows.
/// Cost per sample: O(1) whatever the horizon; no allocation.
class ModelTracker {
 public:
  /// The plain model.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  explicit ModelTracker(const MonitorOptions& options);

  /// Goes on with other effects: estimates and covariance of b1, b0 and of the effects that stay (same name and shapes)
  /// carry over, as does the free run. Coefficients of the others are start values. The estimates are valid again after
  /// valid/min_rows rows of the new model.
  /// @throws std::invalid_argument  as FreeRun::setEffects().
  void setEffects(const std::vector<ActiveEffect>& effects, ModelReport& report);

  const std::vector<ActiveEffect>& effects() const { return free_run_.model().effects; }

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @param time  of the newest sample since the start of the drive [s]; of no effect on the plain model.
  /// @param compared  the sample FreeRun::kDelay before the newest; nullptr: the series is too short yet.
  void add(const CornerSample& newest, double time, const CornerSample* compared, ModelReport& report);

  /// Of a model with effects, as long as it has no valid estimate of its own: sets b1, b0 of the free run, with the
  /// effects' start values.
  void lead(const StrutEstimate& plain);

  void startNewSeries(ModelReport& report);

  /// Another drive begins, perhaps of another vehicle: nothing is held any more.
  void startNewDrive(ModelReport& report);

  /// @param fits  false: no estimate is valid from now on, because samples do not come at the sample period.
  void setPeriodFits(bool fits, ModelReport& report);

  /// From the next row on; the estimates stay.
  /// @param options  of which forgetting_factor and fastest_forgetting_factor count.
  /// @throws std::invalid_argument  as RecursiveOptions::validate().
  void setForgetting(const MonitorOptions& options);

  /// @return the factor that rows are forgotten by now.
  double forgettingFactor() const { return least_absolute_.forgettingFactor(); }

 private:
  // Rows between models of the free run, of which a new one costs as much as a step of it, and between judgements of
  // estimates that are valid; samples between looks for a force from outside.
  static constexpr unsigned kModelEvery = 8;

  void estimate(const RegressionRow& row, ModelReport& report);
  void describe(ModelReport& report) const;
  [[gnu::noinline]] void updateSpecially(const RegressionRow& row);
  void noteSpecialRows() { special_rows_ = variable_ || excitation_doubt_ == EstimateDoubt::kNotExcited; }
  void restartVariableForgetting();
  void noteExcitation();
  void forgetBy(double factor);
  [[gnu::noinline]] void judgeEstimates(bool moves, ModelReport& report);
  [[gnu::noinline]] void takeExcitation(ModelReport& report);
  [[gnu::noinline]] void describeSpreads(ModelReport& report) const;
  EstimateDoubt doubt(const StrutEstimate& estimate) const;
  static double memoryInLooks(double forgetting_factor) { return 1.0 / (1.0 - forgetting_factor) / kModelEvery; }
  void takeModel(const StrutEstimate& la);
  void fallBack();
  [[gnu::noinline]] void lookForOutsideForce(const CornerSample& sample, ModelReport& report);
  void compare(const CornerSample& sample, const std::optional<double>& predicted, ModelReport& report);

  IntegralFilterOptions filter_;
  int valid_min_rows_;
  bool period_fits_ = true;
  double rows_of_force_ = 0.0;    // to come until what a force from outside did is forgotten
  double start_rows_, min_rows_;  // of an estimate that is valid, the first time and from then on
  bool has_been_valid_ = false;   // since the effects were set
  double min_explained_;
  unsigned spread_phase_ = 0;
  MotionJudge motion_;
  double rows_of_model_;  // since the effects were set; infinite for the plain model
  bool has_own_model_ = false;
  std::uint64_t runaways_ = 0;
  std::optional<Excitation> excitation_;  // none: everything is forgotten all the time
  EstimateDoubt excitation_doubt_ = EstimateDoubt::kNone;
  std::optional<VariableForgetting> variable_;  // none: rows are forgotten by one factor
  bool special_rows_ = false;                   // forgotten by a variable factor, or only observed
  SuspensionRegression regression_;
  RegressorNoise noise_;
  RecursiveLeastSquares least_squares_;
  RecursiveLeastAbsolute least_absolute_;
  FreeRun free_run_;
  std::vector<double> starts_;  // of the coefficients
  RunningComparison comparison_;
  OutsideForce outside_force_;
  unsigned compared_ = 0;  // samples
};

}  // namespace suspension_health_monitor
