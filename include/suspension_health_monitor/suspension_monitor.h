#pragma once

#include <cstdint>
#include <optional>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/discrepancy/running_comparison.h"
#include "suspension_health_monitor/health/assessment.h"
#include "suspension_health_monitor/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/identification/recursive_least_squares.h"
#include "suspension_health_monitor/identification/suspension_regression.h"
#include "suspension_health_monitor/model/free_run.h"
#include "suspension_health_monitor/monitor_options.h"
#include "suspension_health_monitor/signal/uniform_grid.h"
#include "suspension_health_monitor/strut_estimate.h"

namespace suspension_health_monitor {

/// The model, driven by the measured wheel acceleration, against the measured body acceleration at one sample.
struct ComparisonReport {
  double measured = 0.0;            ///< z'' [m/s^2]
  std::optional<double> predicted;  ///< by the free run with LA's parameters [m/s^2]; empty until it has settled
  double rmse = std::nan("");       ///< over the window [m/s^2]
  double fit_percent = std::nan("");
};

/// Everything that is known after one sample.
struct MonitorReport {
  Stamp stamp{};
  bool has_row = false;  ///< the sample gave a regression row; false while the filter fills: the estimates then hold
  StrutEstimate ls, la;
  ComparisonReport comparison;
  HealthReport health;
};

/// How the input has been so far.
struct InputStatus {
  std::uint64_t samples = 0;   ///< taken in
  std::uint64_t rows = 0;      ///< regression rows that they gave
  std::uint64_t gaps = 0;      ///< interruptions of at least one sample, after which the filter filled anew
  std::uint64_t restarts = 0;  ///< times that the clock went back and the series began anew
  double mean_period = 0.0;    ///< running mean of the spacing of uninterrupted samples [s]; 0 before the second
};

/// Identifies one strut from a series of samples: the facade that the nodelet, the command line and the tests share.
///
/// Per sample, as in the paper: integral filter (9) -> regression row (28)-(30) -> LS (15)-(17) and LA (24)-(26), then
/// the free run with LA's parameters against the measurement, and the judgement of health by LA's parameters.
/// Cost per sample: O(1) whatever the horizon; no allocation, no lock.
class SuspensionMonitor {
 public:
  /// @param options  with sample_period given.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  explicit SuspensionMonitor(const MonitorOptions& options);

  /// Takes in the next sample. A gap or a clock that goes back empties the filter (2 L samples without rows follow);
  /// estimates hold meanwhile, marked as not valid. They do so, too, after L rows of output exactly 0: without any
  /// noise there is no motion but a sensor that is stuck or a simulated vehicle at rest, and rows that LA hits exactly
  /// would weigh so much that it could not leave them for minutes.
  /// @return the report, owned by this object and valid until the next call; nullptr if the sample was rejected.
  const MonitorReport* addSample(const CornerSample& sample);

  const MonitorReport& report() const { return report_; }
  const InputStatus& input() const { return input_; }
  const RejectCounts& rejected() const { return rejected_; }
  const MonitorOptions& options() const { return options_; }
  double period() const { return toSeconds(period_); }
  int horizonSamples() const { return horizon_samples_; }

 private:
  bool continues(Stamp stamp);
  void startNewSeries();
  void estimate(const RegressionRow& row);
  void compare(const CornerSample& sample);
  bool isValid(const StrutEstimate& estimate) const;

  MonitorOptions options_;
  Stamp period_;
  int horizon_samples_;
  double min_rows_;
  int silent_rows_ = 0;  // rows of output 0 without a break; counts up to L and stays there
  SuspensionRegression regression_;
  RecursiveLeastSquares least_squares_;
  RecursiveLeastAbsolute least_absolute_;
  FreeRun free_run_;
  RunningComparison comparison_;
  HealthAssessment health_;
  RunningMean spacing_;
  std::optional<Stamp> last_stamp_;
  InputStatus input_;
  RejectCounts rejected_;
  MonitorReport report_;
};

}  // namespace suspension_health_monitor
