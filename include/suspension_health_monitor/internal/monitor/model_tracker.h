#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/every_n.h"
#include "suspension_health_monitor/internal/identification/running_comparison.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/monitor/strut_identifier.h"
#include "suspension_health_monitor/internal/monitor_settings.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// One model of the strut, plain or with effects, followed through a drive: the estimation (StrutIdentifier), the
/// decision whether its estimates are valid (doubtOf()), and the free run with LA's parameters against the measurement.
///
/// Rows of the plain model are those of the newest sample. The columns of effects need travel and travel rate, which
/// the free run tells FreeRun::kDelay samples late; so does a model with effects give its rows.
/// Cost per sample: O(1) whatever the horizon; no allocation.
class ModelTracker {
 public:
  /// The plain model.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  explicit ModelTracker(const MonitorSettings& options);

  /// Goes on with other effects: estimates and covariance of b1, b0 and of the effects that stay (same name and shapes)
  /// carry over, as does the free run. Coefficients of the others are start values. The estimates are valid again after
  /// enough rows of the new model.
  /// @param strut  b1 and b0 that belong to the start values; the free run goes on with them until there are estimates.
  /// @throws std::invalid_argument  as FreeRun::setEffects().
  void setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut,
                  ModelReport& report);

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

  /// @param input  from now on no estimate is valid while samples come at another period than that of the options.
  void setInput(const InputStatus& input, ModelReport& report);

  /// As StrutIdentifier::setForgetting().
  void setForgetting(const MonitorSettings& options) { identifier_.setForgetting(options); }

  /// As StrutIdentifier::setInputStddevs().
  void setInputStddevs(const Eigen::Vector2d& stddevs) { identifier_.setInputStddevs(stddevs); }

  /// As StrutIdentifier::setResamplingErrors().
  void setResamplingErrors(const ResamplingErrors& errors) { identifier_.setResamplingErrors(errors); }

  /// @return true while what is measured tells nothing of the strut, and the estimates stay as they are.
  bool holds() const { return identifier_.holdsAll(); }

  const StrutIdentifier& identifier() const { return identifier_; }

  /// @return the factor that rows are forgotten by now.
  double forgettingFactor() const { return identifier_.forgettingFactor(); }

 private:
  void judge(ModelReport& report);
  void takeModel(const StrutEstimate& la);
  void fallBack();
  void compare(const CornerSample& sample, const std::optional<double>& predicted, ModelReport& report);

  StrutIdentifier identifier_;
  bool period_fits_ = true;
  FreeRun free_run_;
  std::vector<double> starts_;  // of the coefficients
  bool has_own_model_ = false;  // the free run has had parameters of LA, or those that belong to the start values
  std::uint64_t runaways_ = 0;
  EveryN model_due_, figures_due_;
  RunningComparison comparison_;
  bool free_run_fails_ = false;
};

}  // namespace suspension_health_monitor
