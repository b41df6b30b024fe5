#pragma once

#include <array>
#include <optional>
#include <string>

#include "suspension_health_monitor/health/assessment.h"
#include "suspension_health_monitor/identification/linear_integral_filter.h"
#include "suspension_health_monitor/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/option_table.h"

namespace suspension_health_monitor {

/// All settings of a SuspensionMonitor, flat as users write them. Name, unit, meaning and range of each stand in
/// kMonitorFields only. Settings that an estimator has, too, take its default.
struct MonitorOptions {
  std::optional<double> sample_period;
  std::optional<double> integration_horizon;
  std::optional<int> horizon_samples;
  std::string integration_rule = "cubic";
  double forgetting_factor = 0.99;
  std::optional<double> fastest_forgetting_factor;
  std::string forgetting_rule = "directional";
  double initial_variance = RecursiveOptions{}.initial_variance;
  std::string initial_variance_rule = "relative";
  int la_start_rows = LeastAbsoluteOptions{}.start_rows;
  std::string la_small_divisor_rule = "relative";
  double la_small_divisor = LeastAbsoluteOptions{}.small_divisor;
  bool la_scale_covariance_at_start = LeastAbsoluteOptions{}.scale_covariance_at_start;
  int valid_min_rows = 50;
  double valid_min_explained = 0.5;
  double comparison_window = 10.0;
  std::optional<double> tyre_horizon;
  std::optional<double> sprung_mass;
  std::optional<double> nominal_damping_to_mass;
  std::optional<double> nominal_stiffness_to_mass;
  double damping_warn = HealthOptions{}.damping_warn;
  double damping_error = HealthOptions{}.damping_error;
  double stiffness_warn = HealthOptions{}.stiffness_warn;
  double stiffness_error = HealthOptions{}.stiffness_error;
  double confirm_time = HealthOptions{}.confirm_time;
  double hysteresis = HealthOptions{}.hysteresis;
  double min_significance = HealthOptions{}.min_significance;
  double payload_range = HealthOptions{}.payload_range;
  double early_change = HealthOptions{}.early_change;
  double false_alarm_interval = HealthOptions{}.false_alarm_interval;
  double gravity_tolerance = HealthOptions{}.gravity_tolerance;
  double learn_time = HealthOptions{}.learn_time;

  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  void validate() const;

  /// The horizon in samples: horizon_samples, or integration_horizon (0.6 s if neither is given) over `period`.
  /// @param period  sampling time [s].
  /// @throws std::invalid_argument  if the horizon is longer than a million samples.
  int horizonSamples(double period) const;

  IntegralFilterOptions filter(double period) const;

  /// That of the wheel's regression: tyre/integration_horizon, or an eighth of the strut's, of at least 5 samples.
  IntegralFilterOptions tyreFilter(double period) const;

  /// @param correlated_rows  2 L for rows of a filter, as each reading of a sensor is in 2 L + 1 of them.
  RecursiveOptions recursive(int correlated_rows = 0) const;
  /// @return the smallest lambda that rows may be forgotten by.
  double fastestForgetting() const { return fastest_forgetting_factor.value_or(forgetting_factor); }
  LeastAbsoluteOptions leastAbsolute() const;
  /// @param period  sampling time [s].
  HealthOptions health(double period) const;
};

using MonitorField = OptionField<MonitorOptions>;
inline constexpr std::array kMonitorFields{
    MonitorField{"sample_period", "s", "sampling time T; left out: measured from the stamps",
                 &MonitorOptions::sample_period, 1e-5, 10.0},
    MonitorField{"integration_horizon", "s", "horizon h of the integral filter; left out: 0.6",
                 &MonitorOptions::integration_horizon, 1e-5, 1e3},
    MonitorField{"horizon_samples", "-", "the horizon as a number of samples L, instead of integration_horizon",
                 &MonitorOptions::horizon_samples, 1, 100000},
    MonitorField{"integration_rule", "-", "trapezoid is the paper's; simpson needs an even L, cubic L >= 5",
                 &MonitorOptions::integration_rule, 0, 0, kIntegrationRuleNames},
    MonitorField{"forgetting_factor", "-", "lambda; memory 1/(1 - lambda) rows, 1 never forgets",
                 &MonitorOptions::forgetting_factor, 0.9, 1.0},
    MonitorField{"fastest_forgetting_factor", "-",
                 "lambda while damping or stiffness move, at most forgetting_factor; left out: lambda stays",
                 &MonitorOptions::fastest_forgetting_factor, 0.9, 1.0},
    MonitorField{"forgetting_rule", "-",
                 "directional: nothing is forgotten without excitation (parked); exponential: always (the paper's)",
                 &MonitorOptions::forgetting_rule, 0, 0, "directional exponential"},
    MonitorField{"initial_variance", "-", "start value of the covariance P", &MonitorOptions::initial_variance, 1e-3,
                 1e15},
    MonitorField{"initial_variance_rule", "-", "absolute (the paper's) or relative to the first regressor",
                 &MonitorOptions::initial_variance_rule, 0, 0, kInitialVarianceNames},
    MonitorField{"la/start_rows", "-", "rows k0 during which LS leads LA", &MonitorOptions::la_start_rows, 1, 1000000},
    MonitorField{"la/small_divisor_rule", "-", "absolute (the paper's) or relative to the running mean residual",
                 &MonitorOptions::la_small_divisor_rule, 0, 0, kSmallDivisorNames},
    MonitorField{"la/small_divisor", "-", "smallest residual that a row's weight is divided by",
                 &MonitorOptions::la_small_divisor, 0.0, 10.0},
    MonitorField{"la/scale_covariance_at_start", "-", "hand P over from LS to LA in LA's unit; false: as in the paper",
                 &MonitorOptions::la_scale_covariance_at_start},
    MonitorField{"valid/min_rows", "-", "rows in the memory before an estimate is valid; capped at 90 % of the memory",
                 &MonitorOptions::valid_min_rows, 2, 1000000},
    MonitorField{"valid/min_explained", "-", "share of the measured signal that the model must explain",
                 &MonitorOptions::valid_min_explained, 0.0, 1.0},
    MonitorField{"comparison_window", "s", "memory of rmse and fit of the free run, and of the check of the sensors",
                 &MonitorOptions::comparison_window, 1e-3, 1e5},
    MonitorField{"tyre/integration_horizon", "s",
                 "horizon of the wheel's regression, near one period of its hop; left out: an eighth of the strut's",
                 &MonitorOptions::tyre_horizon, 1e-5, 1e3},
    MonitorField{"sprung_mass", "kg", "body mass on this strut, for damping and stiffness in SI",
                 &MonitorOptions::sprung_mass, 1e-6, 1e6},
    MonitorField{"nominal/damping_to_mass", "1/s", "b1 of the healthy strut", &MonitorOptions::nominal_damping_to_mass,
                 1e-9, 1e9},
    MonitorField{"nominal/stiffness_to_mass", "1/s^2", "b0 of the healthy strut",
                 &MonitorOptions::nominal_stiffness_to_mass, 1e-9, 1e12},
    MonitorField{"health/damping_warn", "-", "relative change of damping that warns", &MonitorOptions::damping_warn,
                 0.001, 10.0},
    MonitorField{"health/damping_error", "-", "relative change of damping that is an error",
                 &MonitorOptions::damping_error, 0.001, 10.0},
    MonitorField{"health/stiffness_warn", "-", "relative change of stiffness that warns",
                 &MonitorOptions::stiffness_warn, 0.001, 10.0},
    MonitorField{"health/stiffness_error", "-", "relative change of stiffness that is an error",
                 &MonitorOptions::stiffness_error, 0.001, 10.0},
    MonitorField{"health/confirm_time", "s", "a new level must last this long before it is reported",
                 &MonitorOptions::confirm_time, 0.0, 3600.0},
    MonitorField{"health/hysteresis", "-",
                 "a level ends this far below its threshold, or a standard deviation if that is more",
                 &MonitorOptions::hysteresis, 0.0, 1.0},
    MonitorField{"health/min_significance", "-",
                 "standard deviations that a change must have to count; half, to go on counting",
                 &MonitorOptions::min_significance, 0.0, 100.0},
    MonitorField{"health/payload_range", "-", "relative change of body mass that may be payload; 0: no change may",
                 &MonitorOptions::payload_range, 0.0, 10.0},
    MonitorField{"health/early_change", "-", "smaller changes of a parameter need no early warning",
                 &MonitorOptions::early_change, 0.001, 10.0},
    MonitorField{"health/false_alarm_interval", "s", "mean time between two early warnings of a healthy strut",
                 &MonitorOptions::false_alarm_interval, 1.0, 1e12},
    MonitorField{"health/gravity_tolerance", "-", "share of g by which a mean reading may be off; 0: not judged",
                 &MonitorOptions::gravity_tolerance, 0.0, 0.5},
    MonitorField{"baseline/learn_time", "s", "valid driving that a baseline is learned from; 0: none is learned",
                 &MonitorOptions::learn_time, 0.0, 1e6},
};

}  // namespace suspension_health_monitor
