#pragma once

#include <optional>

#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/health/health_rules.h"
#include "suspension_health_monitor/monitor_options.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// @throws std::invalid_argument  if an error threshold is below its warning threshold, or friction is given without
/// its gain, or the other way round.
void requireConsistent(const HealthThresholds& thresholds);

/// Judges damping and stiffness by their change from the healthy strut: nominal values, or a baseline that it learns.
///
/// - What is judged is the block estimate, whose standard deviations and correlation decide what is certain.
/// - A baseline is compared as it would be on the present road (changeFrom()), a steady change without its lag
///   (ChangeTrend).
/// - Residuals of LS that have heavy tails for long are reported: outliers.
/// - Payload moves both parameters, damage one (splitChange()).
/// - What all dampers of a vehicle share is their temperature: below the error threshold a damper is judged by what it
///   has beyond it.
/// - A level needs the size and the significance in two estimates in a row and for the confirm time
///   (LevelConfirmation). It ends when the change is 0.02 below the threshold, or a standard deviation if that is
///   more, or has lost half of the significance. A change that the error threshold could not prove is kStale, "cannot
///   tell", as is an estimate that is not valid; never "healthy". While a sensor is at fault the level is WARN at most.
/// - Early warning: EarlyWarning over the changes of windows that share no reading.
/// Cost per update: O(1), no allocation.
class HealthAssessment {
 public:
  explicit HealthAssessment(const HealthThresholds& options);

  /// @param stamp  now; stamps that go back restart the confirmation.
  /// @param estimate  of the blocks.
  /// @param is_new  it has come since the last update: else only its validity is judged.
  const HealthReport& update(Stamp stamp, const StrutEstimate& estimate, bool is_new);

  /// @param sensor  what is known of the sensors; counts from the next update().
  void setSensors(const SensorReport& sensor) { sensor_ = sensor; }

  /// The strut is one of three or more of a vehicle. Counts from the next update().
  /// @param others  the damping's change that all other struts share; empty: not known yet, as at the first judgement,
  /// which therefore raises no WARN for the damping.
  void setOthers(const std::optional<Measured>& others) {
    others_ = others;
    awaits_others_ = !others;
  }

  /// @return ln of damping over the healthy strut's by the newest estimate, without a load; empty: not known.
  const std::optional<Measured>& dampingChange() const { return damping_change_; }

  /// LS as it is now, to be called for each check of the sensors.
  void watch(const StrutEstimate& ls) { outlying_ += ((ls.tails > kHeavy ? 1.0 : 0.0) - outlying_) / kOutlyingMemory; }

  /// Judges by this from now on; learning ends.
  void setBaseline(const Baseline& baseline);
  const Baseline& baseline() const { return baseline_; }
  const HealthReport& report() const { return report_; }

  /// Judges by other thresholds from now on; a level that is being confirmed stays so.
  /// @throws std::invalid_argument  as requireConsistent(); the thresholds then stay as they were.
  void setOptions(const HealthThresholds& options);

 private:
  static constexpr double kHeavy = 4.0;  // StrutEstimate::tails: 2 as Laplace's, twice that
  static constexpr double kOutlyingOften = 0.4;
  static constexpr double kOutlyingMemory = 50.0;

  /// What is followed of damping or of stiffness.
  struct Parameter {
    ChangeTrend trend;
    EarlyWarning early;
    HealthLevel level = HealthLevel::kOk;  // before it is confirmed
  };

  void take(Stamp stamp, const StrutEstimate& estimate);
  void noteLoad(const StrutChange& change);
  LoadDoubt doubtOfLoad(const StrutChange& change) const;
  void judge(const StrutChange& change);

  HealthThresholds options_;
  LevelConfirmation confirmation_;
  Baseline baseline_;
  std::optional<BaselineLearner> learner_;
  Parameter damping_, stiffness_;
  double outlying_ = 0.0;       // share of the newest calls of watch() in which the tails were heavy
  double known_load_ = 0.0;     // ln of the body's mass over the healthy vehicle's, when last nothing else had changed
  double since_early_ = 0.0;    // seconds since the early warning saw the newest change
  std::optional<Stamp> taken_;  // when the newest estimate came
  HealthReport judged_;         // what that estimate says
  Stamp report_stamp_{};
  SensorReport sensor_;
  std::optional<Measured> others_, damping_change_;
  bool awaits_others_ = false;
  HealthReport report_;
};

}  // namespace suspension_health_monitor
