#pragma once

#include <cmath>
#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/health/early_warning.h"
#include "suspension_health_monitor/internal/health/level_confirmation.h"
#include "suspension_health_monitor/internal/health/parameter_trend.h"
#include "suspension_health_monitor/internal/health/sensor_check.h"
#include "suspension_health_monitor/internal/health/strut_change.h"
#include "suspension_health_monitor/internal/monitor/strut_estimate.h"

namespace suspension_health_monitor {

struct HealthOptions {
  std::optional<double> nominal_damping_to_mass;    ///< b1 of the healthy strut [1/s]
  std::optional<double> nominal_stiffness_to_mass;  ///< b0 of the healthy strut [1/s^2]
  double damping_warn = 0.15;                       ///< relative change that is a warning [-]
  double damping_error = 0.30;                      ///< relative change that is an error [-]
  double stiffness_warn = 0.15;
  double stiffness_error = 0.30;
  double confirm_time = 0.5;          ///< a new level must last this long before it is reported [s]
  double hysteresis = 0.02;           ///< a level ends this far below its threshold, or a standard deviation [-]
  double min_significance = 4.0;      ///< standard deviations that a change must have to be one
  double payload_range = 0.35;        ///< relative change of the body's mass that may be payload; 0: none
  double learn_time = 60.0;           ///< of valid estimates, when there are no nominal values [s]; 0: never
  double early_change = 0.03;         ///< smaller changes need no early warning [-]
  double false_alarm_interval = 1e6;  ///< mean time between two early warnings of a healthy strut [s]
  double gravity_tolerance = 0.1;     ///< of a mean reading, as a share of g; 0: not judged
  double forgetting_factor = 0.99;    ///< of the estimates that are judged
  int horizon_samples = 30;           ///< L of their filter
  double period = 0.02;               ///< of a row [s]
  int rows_per_update = 1;            ///< rows from one update() to the next

  /// @throws std::invalid_argument  if an error threshold is below its warning threshold.
  void validate() const;
};

struct HealthReport {
  HealthLevel level = HealthLevel::kStale;
  std::optional<double> damping_change;        ///< beta / healthy - 1 [-]; empty without healthy value or estimate
  std::optional<double> stiffness_change;      ///< K / healthy - 1 [-]
  std::optional<double> payload_change;        ///< M / healthy - 1 [-]; needs both healthy values
  double damping_significance = std::nan("");  ///< change in its standard deviations; NaN: not known
  double stiffness_significance = std::nan("");
  HealthLevel damping_level = HealthLevel::kOk;
  HealthLevel stiffness_level = HealthLevel::kOk;
  bool estimate_valid = false;                   ///< of LA
  EstimateDoubt doubt = EstimateDoubt::kNoRows;  ///< why it is not
  bool uncertain = false;      ///< valid, but a change as large as the error threshold would not be significant
  bool early_warning = false;  ///< a small change is certain before it reaches a threshold; raises no level
  bool outliers = false;       ///< LS and LA have disagreed for long: outliers or saturation
  SensorReport sensor;
  bool learned = false;             ///< judged by a baseline from a drive, else by nominal values
  std::optional<double> learning;   ///< progress 0..1 of learning the baseline
  bool learning_restarted = false;  ///< because the strut was changing
};

/// Judges damping and stiffness by their change from the healthy strut: nominal values, or a baseline that it learns.
///
/// - What is judged: the trend of LS or of LA, which have no lag behind a steady change (FollowedParameter).
/// - LS and LA that are more than kAgreement standard deviations of LA apart, or of which LS is more than kTails times
///   as uncertain, disagree: there are outliers, or was a step. If they do for long, that is reported.
/// - Payload moves both parameters, damage one (splitChange()).
/// - A level needs the size and the significance, and must last for the confirm time (LevelConfirmation). It ends when
///   the change is below the threshold by the hysteresis, or a standard deviation if that is more, or has lost half of
///   the significance. A change that the error threshold could not prove is kStale, "cannot tell", as is an estimate
///   that is not valid; never "healthy". A sensor that is at fault makes an error a warning: who knows.
/// - Early warning: EarlyWarning over the changes, one every two memories and horizons.
/// Cost per update: O(1), no allocation.
class HealthAssessment {
 public:
  explicit HealthAssessment(const HealthOptions& options);

  /// @param stamp  of the sample that the estimates include; stamps that go back restart the confirmation.
  const HealthReport& update(Stamp stamp, const StrutEstimate& ls, const StrutEstimate& la);

  /// @param sensor  what is known of the sensors; counts from the next update().
  void setSensors(const SensorReport& sensor) { sensor_ = sensor; }

  /// For estimators that forget faster than forgetting_factor for the time being.
  /// @param rows  that the estimates to come rest on; no more than forgetting_factor says count.
  void setMemory(double rows);

  /// Judges by this from now on; learning ends.
  void setBaseline(const Baseline& baseline);
  const Baseline& baseline() const { return baseline_; }

  /// Judges by other thresholds from now on; a level that is being confirmed stays so.
  /// @throws std::invalid_argument  as HealthOptions::validate(); the thresholds then stay as they were.
  void setOptions(const HealthOptions& options);

  const HealthReport& report() const { return report_; }
  const HealthOptions& options() const { return options_; }

 private:
  static constexpr double kAgreement = 3.0, kTails = 2.5;
  static constexpr double kOutlierShare = 0.4, kOutlierMemories = 10.0;

  /// What is followed of damping or of stiffness.
  struct Parameter {
    FollowedParameter course;
    EarlyWarning early;
    HealthLevel level = HealthLevel::kOk;  // before it is confirmed
  };

  void follow(const StrutEstimate& ls, const StrutEstimate& la);
  StrutChange change() const;
  void judge(const StrutChange& change, HealthReport& now);
  void warnEarly(const StrutChange& change);

  HealthOptions options_;
  double memory_;  // of the estimates, in updates
  LevelConfirmation confirmation_;
  Baseline baseline_;
  std::optional<BaselineLearner> learner_;
  Parameter damping_, stiffness_;
  bool agree_ = false;         // LS and LA
  double disagreement_ = 0.0;  // share of the updates
  double since_early_ = 0.0;   // updates since the early warning saw the newest change
  SensorReport sensor_;
  HealthReport report_;
};

}  // namespace suspension_health_monitor
