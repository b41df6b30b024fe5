#include "suspension_health_monitor/internal/monitor/monitor_settings.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

constexpr double kDefaultHorizon = 0.6;          // [s], the paper's
constexpr double kFewestSamplesOfMemory = 10.0;  // lambda = 0.9

MonitorOptions MonitorOptions::of(const std::string& preset) {
  MonitorOptions options;
  options.preset = preset;
  if (preset != "paper") return options;
  options.integration_horizon = kDefaultHorizon;  // L = 30 at its T = 0.02 s
  options.forgetting_factor = 0.98;               // lambda, memory of 50 rows
  return options;
}

void MonitorOptions::validate() const { MonitorSettings(*this).validate(); }

MonitorOptions takeMonitorOptions(OptionMap& values) {
  MonitorOptions given;
  OptionMap copy = values;
  takeOptions(copy, kMonitorFields, given);
  MonitorOptions options = MonitorOptions::of(given.preset);
  takeOptions(values, kMonitorFields, options);
  return options;
}

MonitorSettings::MonitorSettings(const MonitorOptions& options) : MonitorOptions(options) {
  estimators.drifting_offset = preset != "paper";
  if (preset != "paper") return;
  integration_rule = IntegrationRule::kTrapezoid;  // Eq. (9)
  forgets_unexcited = true;
  estimators.initial_variance = 1e5;  // P(0) = diag(1e5, 1e5)
  estimators.initial_variance_rule = InitialVariance::kAbsolute;
  estimators.start_rows = 150;  // k0, and eps_min: section 3.2
  estimators.small_divisor_rule = SmallDivisor::kAbsolute;
  estimators.small_divisor = 1e-8;
  estimators.scale_covariance_at_start = false;
}

void MonitorSettings::validate() const {
  suspension_health_monitor::validate<MonitorOptions>(*this, kMonitorFields);
  requireConsistent(*this);
  if (!sample_period) return;
  filter(*sample_period);
  if (forgettingFactor(*sample_period) < 1.0 - 1.0 / kFewestSamplesOfMemory - kRounding)
    refuse("memory", presentMemory(), "s",
           "at least " + numberText(kFewestSamplesOfMemory * *sample_period) +
               " [s], ten samples of sample_period = " + numberText(*sample_period) + " [s]");
}

int MonitorSettings::horizonSamples(double period) const {
  const double horizon = presentHorizon();
  if (horizon / period > kMostHorizonSamples)
    refuse("integration_horizon", horizon, "s",
           "at most " + std::to_string(kMostHorizonSamples) + " samples of sample_period = " + numberText(period) +
               " [s]");
  return static_cast<int>(std::lround(horizon / period));
}

IntegralFilterOptions MonitorSettings::filter(double period) const {
  const IntegralFilterOptions filter{horizonSamples(period), period, integration_rule};
  prefixed("integration_horizon = " + numberText(presentHorizon()) + " [s] with sample_period = " + numberText(period) +
               " [s] makes ",
           [&] { HorizonIntegral(filter.horizon_samples, filter.period, filter.rule); });
  return filter;
}

IntegralFilterOptions MonitorSettings::tyreFilter(double period) const {
  constexpr double kShare = 1.0 / 8.0;
  constexpr int kFewestSamples = 5;
  const auto samples = static_cast<int>(std::lround(kShare * horizonSamples(period)));
  return {std::max(kFewestSamples, samples), period, integration_rule};
}

GridOptions MonitorSettings::grid(double period) const {
  return {suspension_health_monitor::alignment(alignment), samplesOfRow(period)};
}

RecursiveOptions MonitorSettings::recursive(int correlated_rows) const {
  RecursiveOptions recursive = estimators;
  recursive.forgetting_factor = forgettingFactor(*sample_period);
  recursive.correlated_rows = correlated_rows;
  return recursive;
}

double MonitorSettings::presentHorizon() const { return integration_horizon.value_or(kDefaultHorizon); }

double MonitorSettings::presentBlockLength() const {
  // A factor of two is left to the blocks themselves, which follow the bounce.
  const double apart = std::abs(std::round(std::log2(presentHorizon() / kDefaultHorizon)));
  // Horizons that the data propose are a fourth of the bounce's period, and a block holds three of these.
  constexpr double kHorizons = 12.0;
  const double octaves = std::round(std::log2(kHorizons * presentHorizon() / kBlockTuning.length));
  return block_length.value_or(kBlockTuning.length * (apart > 1.0 ? std::exp2(octaves) : 1.0));
}

double MonitorSettings::presentMemory() const {
  constexpr double kLeast = 2.0, kHorizons = 10.0 / 3.0;  // the same for the default horizon
  return memory.value_or(std::max(kLeast, kHorizons * presentHorizon()));
}

double MonitorSettings::fewestRows(double horizons, double period) const {
  constexpr double kShare = 0.9;
  const double forgotten = std::max(1.0 - forgettingFactor(period), 1e-12);
  return std::min(horizons * horizonSamples(period), kShare / forgotten);
}

}  // namespace suspension_health_monitor
