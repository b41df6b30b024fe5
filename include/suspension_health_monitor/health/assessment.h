#pragma once

#include <optional>
#include <string>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/strut_estimate.h"

namespace suspension_health_monitor {

/// Severity, numbered as in diagnostic_msgs/DiagnosticStatus.
enum class HealthLevel : unsigned char { kOk = 0, kWarn = 1, kError = 2, kStale = 3 };

struct HealthOptions {
  std::optional<double> nominal_damping_to_mass;    ///< b1 of the healthy strut [1/s]
  std::optional<double> nominal_stiffness_to_mass;  ///< b0 of the healthy strut [1/s^2]
  double damping_warn = 0.15;                       ///< relative change that is a warning [-]
  double damping_error = 0.30;                      ///< relative change that is an error [-]
  double stiffness_warn = 0.15;
  double stiffness_error = 0.30;
  double confirm_time = 1.0;  ///< a new level must last this long before it is reported [s]

  /// @throws std::invalid_argument  if an error threshold is below its warning threshold.
  void validate() const;
};

struct HealthReport {
  HealthLevel level = HealthLevel::kStale;
  std::optional<double> damping_change;    ///< b1 / nominal - 1 [-]; empty without nominal value or estimate
  std::optional<double> stiffness_change;  ///< b0 / nominal - 1 [-]
  HealthLevel damping_level = HealthLevel::kOk;
  HealthLevel stiffness_level = HealthLevel::kOk;
};

/// Judges damping and stiffness by their relative change from nominal values.
/// An estimate that is not valid gives kStale: "cannot tell", never "healthy".
/// A level is reported once it has lasted for the confirm time. While levels alternate that are all worse (or all
/// better) than the reported one, the one nearest to it counts as lasting, so that noise at a threshold hides nothing.
/// Cost per estimate: O(1), no allocation.
class HealthAssessment {
 public:
  explicit HealthAssessment(const HealthOptions& options);

  /// @param stamp  of the sample that the estimate includes; stamps that go back restart the confirmation.
  const HealthReport& update(Stamp stamp, const StrutEstimate& estimate);

  /// Judges by other thresholds from now on; a level that is being confirmed stays so.
  /// @throws std::invalid_argument  as HealthOptions::validate(); the thresholds then stay as they were.
  void setOptions(const HealthOptions& options);

  const HealthReport& report() const { return report_; }
  const HealthOptions& options() const { return options_; }

 private:
  HealthOptions options_;
  Stamp confirm_time_;
  HealthReport report_;
  HealthLevel pending_ = HealthLevel::kStale;
  Stamp pending_since_{};
};

/// @return the report in one sentence for a person, e.g. "damping 31 % below nominal".
std::string describe(const HealthReport& report);

}  // namespace suspension_health_monitor
