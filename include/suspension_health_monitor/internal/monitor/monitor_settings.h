#pragma once

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/health/assessment.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/monitor_options.h"

namespace suspension_health_monitor {

inline constexpr int kMostHorizonSamples = 100000;  ///< more is a wrong unit

/// The options of a monitor with what follows from them: the preset's way to make rows and to estimate, and the
/// settings of each part. Group, name, unit, meaning and range of each option stand in kMonitorFields only.
struct MonitorSettings : MonitorOptions {
  // What a preset sets and no option can: how rows are made, and how the estimators begin, weigh and forget.
  IntegrationRule integration_rule = IntegrationRule::kBandLimited;
  bool forgets_unexcited = false;  ///< true: rows of a parked vehicle count, too, as in the paper
  /// Of strut and wheel; recursive() sets the forgetting factor and the correlated rows. An offset that drifts, as by
  /// every preset but "paper", needs two parameters more.
  RecursiveOptions estimators;

  MonitorSettings(const MonitorOptions& options = {});  // NOLINT(google-explicit-constructor): options in other words

  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  void validate() const;

  /// The horizon in samples: integration_horizon (0.6 s if it is left out) over `period`.
  /// @param period  sampling time [s].
  /// @throws std::invalid_argument  if the horizon is longer than 100000 samples.
  int horizonSamples(double period) const;

  IntegralFilterOptions filter(double period) const;

  /// @return samples in a row that make one row of the regression.
  int samplesOfRow(double period) const { return LinearIntegralFilter::window(2, filter(period)); }

  /// That of the wheel's regression, whose best horizon is near one period of its hop: an eighth of the strut's, of at
  /// least 5 samples.
  IntegralFilterOptions tyreFilter(double period) const;

  /// How readings become samples.
  GridOptions grid(double period) const;

  /// With sample_period given.
  /// @param correlated_rows  2 L for rows of a filter, as each reading of a sensor is in 2 L + 1 of them.
  RecursiveOptions recursive(int correlated_rows) const;

  /// @param period  sampling time [s].
  /// @return lambda: forgetting_factor, or that of memory.
  double forgettingFactor(double period) const { return forgetting_factor.value_or(1.0 - period / presentMemory()); }

  /// @return integration_horizon [s], or what it is if it is left out.
  double presentHorizon() const;

  /// @return block_length [s], or what it is if it is left out: 2 s, or as many times as long, by a power of two, as
  /// the horizon is longer than 0.6 s, if that is more than two or less than a half.
  double presentBlockLength() const;

  /// @return memory [s], or what it is if it is left out.
  double presentMemory() const;

  /// @param period  sampling time [s].
  /// @return so many horizons of rows, or nine tenths of a shorter memory.
  double fewestRows(double horizons, double period) const;
};

/// Takes the options that `values` names out of it; what is not among them is the preset's.
/// @throws std::invalid_argument  as takeOptions().
MonitorOptions takeMonitorOptions(OptionMap& values);

inline constexpr OptionField<MonitorOptions> kMonitorFields[] = {
    {"input", "sample_period", "s", "sampling time T; left out: measured from the stamps",
     &MonitorOptions::sample_period, 1e-5, 10.0},
    {"input", "alignment", "-",
     "paired: by stamp; resampled: onto a grid; auto: paired as long as enough readings have a partner",
     &MonitorOptions::alignment, 0, 0, kAlignmentNames},
    {"estimation", "preset", "-",
     "paper: estimators as in the paper, forgetting_factor 0.98 and integration_horizon 0.6 unless given",
     &MonitorOptions::preset, 0, 0, "default paper"},
    {"estimation", "integration_horizon", "s",
     "horizon h of the integral filter, near one period of the body's bounce; left out: 0.6",
     &MonitorOptions::integration_horizon, 1e-5, 1e6},
    {"estimation", "block_length", "s",
     "length of the estimate's first blocks; left out: 2, or as integration_horizon; then it follows the period of the "
     "body's bounce by factors of two",
     &MonitorOptions::block_length, 1e-3, 1e3},
    {"estimation", "memory", "s",
     "memory of LS and LA: data of this age have the weight 1/e; at least 10 samples; left out: 2 or 10/3 of the "
     "horizon, whichever is longer",
     &MonitorOptions::memory, 1e-4, 1e6},
    {"estimation", "forgetting_factor", "-",
     "lambda, in place of memory: a memory of 1/(1 - lambda) samples, 1 never forgets; left out: computed from memory",
     &MonitorOptions::forgetting_factor, 0.9, 1.0},
    {"model", "sprung_mass", "kg", "body mass on this strut, for damping and stiffness in SI",
     &MonitorOptions::sprung_mass, 1e-6, 1e6},
    {"health", "nominal/damping_to_mass", "1/s", "b1 of the healthy strut", &MonitorOptions::nominal_damping_to_mass,
     1e-9, 1e9},
    {"health", "nominal/stiffness_to_mass", "1/s^2", "b0 of the healthy strut",
     &MonitorOptions::nominal_stiffness_to_mass, 1e-9, 1e12},
    {"health", "nominal/friction", "m/s^2", "dry friction of the healthy strut, which b1 does not contain",
     &MonitorOptions::nominal_friction, -1e6, 1e6},
    {"health", "nominal/friction_gain", "s/m", "1 m/s^2 of friction acted as so much of b1 where b1 is from",
     &MonitorOptions::nominal_friction_gain, 0.0, 1e9},
    {"health", "health/damping_warn", "-", "relative change of damping from which the level is WARN",
     &MonitorOptions::damping_warn, 0.001, 10.0},
    {"health", "health/damping_error", "-", "relative change of damping from which the level is ERROR",
     &MonitorOptions::damping_error, 0.001, 10.0},
    {"health", "health/stiffness_warn", "-", "relative change of stiffness from which the level is WARN",
     &MonitorOptions::stiffness_warn, 0.001, 10.0},
    {"health", "health/stiffness_error", "-", "relative change of stiffness from which the level is ERROR",
     &MonitorOptions::stiffness_error, 0.001, 10.0},
    {"health", "health/confirm_time", "s", "a new level must last this long before it is reported",
     &MonitorOptions::confirm_time, 0.0, 3600.0},
    {"health", "health/payload_range", "-", "largest relative change of body mass that counts as payload; 0: none does",
     &MonitorOptions::payload_range, 0.0, 10.0},
    {"health", "health/oldest_data", "s",
     "maximum age of the data of an estimate, as when the vehicle is parked; with older data Health is STALE",
     &MonitorOptions::oldest_data, 1e-3, 1e9},
    {"health", "baseline/learn_time", "s", "valid driving time from which a baseline is learned; 0: none is learned",
     &MonitorOptions::learn_time, 0.0, 1e6},
    {"output", "comparison_window", "s", "memory of the free run's rmse and fit, and of the sensor checks",
     &MonitorOptions::comparison_window, 1e-3, 1e5},
};

}  // namespace suspension_health_monitor
