#include "suspension_health_monitor/monitor_options.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

constexpr double kDefaultHorizon = 0.6;    // [s], the paper's
constexpr int kMostSamples = 100000;       // as of horizon_samples
constexpr int kUpdatesPerTwoHorizons = 3;  // of health: rows within a horizon share most of their samples

}  // namespace

void MonitorOptions::validate() const {
  suspension_health_monitor::validate(*this, kMonitorFields);
  if (integration_horizon && horizon_samples)
    throw std::invalid_argument("integration_horizon and horizon_samples are both given, must be one of them");
  if (fastest_forgetting_factor && *fastest_forgetting_factor > forgetting_factor)
    throw std::invalid_argument("fastest_forgetting_factor = " + std::to_string(*fastest_forgetting_factor) +
                                ", must be at most forgetting_factor = " + std::to_string(forgetting_factor));
  health(sample_period.value_or(1.0)).validate();
  if (sample_period) filter(*sample_period);
}

int MonitorOptions::horizonSamples(double period) const {
  if (horizon_samples) return *horizon_samples;
  const double horizon = integration_horizon.value_or(kDefaultHorizon);
  if (horizon / period > kMostSamples)
    throw std::invalid_argument("integration_horizon = " + std::to_string(horizon) + " [s], must be at most " +
                                std::to_string(kMostSamples) + " samples of sample_period = " + std::to_string(period) +
                                " [s]");
  return static_cast<int>(std::lround(horizon / period));
}

IntegralFilterOptions MonitorOptions::filter(double period) const {
  const IntegralFilterOptions filter{horizonSamples(period), period, integrationRule(integration_rule)};
  try {
    HorizonIntegral(filter.horizon_samples, filter.period, filter.rule);
  } catch (const std::invalid_argument& error) {
    if (horizon_samples) throw;  // the user's own words
    throw std::invalid_argument(
        "integration_horizon = " + std::to_string(integration_horizon.value_or(kDefaultHorizon)) +
        " [s] with sample_period = " + std::to_string(period) + " [s] makes " + error.what());
  }
  return filter;
}

IntegralFilterOptions MonitorOptions::tyreFilter(double period) const {
  MonitorOptions options = *this;
  constexpr double kShare = 1.0 / 8.0;
  constexpr int kFewestSamples = 5;
  const double horizon = tyre_horizon.value_or(kShare * horizonSamples(period) * period);
  options.integration_horizon.reset();
  options.horizon_samples = std::max(kFewestSamples, static_cast<int>(std::lround(horizon / period)));
  if (options.integration_rule == "simpson" && *options.horizon_samples % 2 != 0) ++*options.horizon_samples;
  return options.filter(period);
}

RecursiveOptions MonitorOptions::recursive(int correlated_rows) const {
  return {forgetting_factor, initial_variance,
          initial_variance_rule == "relative" ? InitialVariance::kRelative : InitialVariance::kAbsolute,
          correlated_rows};
}

LeastAbsoluteOptions MonitorOptions::leastAbsolute() const {
  return {la_start_rows, la_small_divisor_rule == "relative" ? SmallDivisor::kRelative : SmallDivisor::kAbsolute,
          la_small_divisor, la_scale_covariance_at_start};
}

HealthOptions MonitorOptions::health(double period) const {
  HealthOptions health;
  health.nominal_damping_to_mass = nominal_damping_to_mass;
  health.nominal_stiffness_to_mass = nominal_stiffness_to_mass;
  health.damping_warn = damping_warn;
  health.damping_error = damping_error;
  health.stiffness_warn = stiffness_warn;
  health.stiffness_error = stiffness_error;
  health.confirm_time = confirm_time;
  health.hysteresis = hysteresis;
  health.min_significance = min_significance;
  health.payload_range = payload_range;
  health.learn_time = learn_time;
  health.early_change = early_change;
  health.false_alarm_interval = false_alarm_interval;
  health.gravity_tolerance = gravity_tolerance;
  health.forgetting_factor = forgetting_factor;
  health.horizon_samples = horizonSamples(period);
  health.period = period;
  health.rows_per_update = std::max(1, 2 * health.horizon_samples / kUpdatesPerTwoHorizons);
  return health;
}

}  // namespace suspension_health_monitor
