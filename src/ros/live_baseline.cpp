#include "live_baseline.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <locale>
#include <sstream>
#include <stdexcept>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "whole_file.h"
#include "yaml_settings.h"

namespace suspension_health_monitor {
namespace {

/// A baseline as its file has it: what may be missing there is apart.
struct BaselineSettings : Baseline {
  std::optional<double> scatter_of_damping, scatter_of_stiffness;  // none is not written
  std::optional<double> dry_friction, dry_friction_stddev, friction_damping_gain, friction_damping_covariance;
  std::optional<double> friction_stiffness_gain;  // of files up to 1a5605d
  std::optional<double> celsius, per_kelvin, per_kelvin_stddev;
  std::optional<double> integration_horizon, sample_period;
  std::optional<double> learned_from, learned_to;
};

constexpr OptionField<BaselineSettings> kBaselineFields[] = {
    {"damping_to_mass", "1/s", "b1 of the healthy strut", &BaselineSettings::damping_to_mass, 1e-9, 1e9},
    {"damping_to_mass_stddev", "1/s", "its standard deviation", &BaselineSettings::damping_to_mass_stddev, 0.0, 1e9},
    {"stiffness_to_mass", "1/s^2", "b0 of the healthy strut", &BaselineSettings::stiffness_to_mass, 1e-9, 1e12},
    {"stiffness_to_mass_stddev", "1/s^2", "its standard deviation", &BaselineSettings::stiffness_to_mass_stddev, 0.0,
     1e12},
    {"damping_scatter", "1/s", "of healthy windows, beyond their standard deviations",
     &BaselineSettings::scatter_of_damping, 0.0, 1e9},
    {"stiffness_scatter", "1/s^2", "likewise, of b0", &BaselineSettings::scatter_of_stiffness, 0.0, 1e12},
    {"dry_friction", "m/s^2", "that the strut had besides, over the body's mass; left out: not known",
     &BaselineSettings::dry_friction, -1e6, 1e6},
    {"dry_friction_stddev", "m/s^2", "its standard deviation", &BaselineSettings::dry_friction_stddev, 0.0, 1e6},
    {"friction_damping_gain", "s/m", "what 1 m/s^2 of it made of b1 on that road",
     &BaselineSettings::friction_damping_gain, -1e9, 1e9},
    {"friction_damping_covariance", "m/s^3", "of the errors of b1 and the friction",
     &BaselineSettings::friction_damping_covariance, -1e9, 1e9},
    {"friction_stiffness_gain", "1/m", "of files whose b1 has the friction's share in it: not used",
     &BaselineSettings::friction_stiffness_gain, -1e12, 1e12},
    {"temperature", "deg C", "of the damper when it was learned; left out: it had no thermometer",
     &BaselineSettings::celsius, -1e4, 1e4},
    {"damping_per_kelvin", "1/K", "change of ln b1 with it", &BaselineSettings::per_kelvin, -1.0, 1.0},
    {"damping_per_kelvin_stddev", "1/K", "its standard deviation", &BaselineSettings::per_kelvin_stddev, 0.0, 1.0},
    {"integration_horizon", "s", "of the filter that it was learned with", &BaselineSettings::integration_horizon, 0.0,
     1e9},
    {"sample_period", "s", "likewise", &BaselineSettings::sample_period, 1e-5, 10.0},
    {"learned_from", "s", "stamp of the first estimate", &BaselineSettings::learned_from, 0.0, 9e9},
    {"learned_to", "s", "stamp of the last estimate", &BaselineSettings::learned_to, 0.0, 9e9},
};

double needed(const std::optional<double>& value, const char* name) {
  if (!value) throw std::invalid_argument(std::string(name) + " is missing, must be given");
  return *value;
}

// What a file holds may be less certain than what save() accepts now, since other thresholds may have held then; but a
// value that is not known to half of itself can prove nothing.
void checkStddev(double stddev, double value, const char* name) {
  if (!(stddev <= 0.5 * value))
    throw std::invalid_argument(std::string(name) + "_stddev = " + numberText(stddev) + ", must be at most half of " +
                                name + " = " + numberText(value));
}

// Files without that covariance were learned by recursive least squares: friction is a part of their b1, and their
// noise shifted them by what the blocks do not have.
void widen(Baseline& baseline) {
  constexpr double kOfEstimator = 0.02;  // of the value, measured by accuracy_table
  baseline.damping_to_mass_stddev =
      std::hypot(baseline.damping_to_mass_stddev, kOfEstimator * *baseline.damping_to_mass);
  baseline.stiffness_to_mass_stddev =
      std::hypot(baseline.stiffness_to_mass_stddev, kOfEstimator * *baseline.stiffness_to_mass);
  if (baseline.friction) *baseline.damping_to_mass -= baseline.friction->force * baseline.friction->damping_gain;
}

Baseline toBaseline(const BaselineSettings& settings) {
  Baseline baseline = static_cast<const Baseline&>(settings);
  const double damping = needed(baseline.damping_to_mass, "damping_to_mass");
  const double stiffness = needed(baseline.stiffness_to_mass, "stiffness_to_mass");
  checkStddev(baseline.damping_to_mass_stddev, damping, "damping_to_mass");
  checkStddev(baseline.stiffness_to_mass_stddev, stiffness, "stiffness_to_mass");
  baseline.damping_scatter = settings.scatter_of_damping.value_or(0.0);
  baseline.stiffness_scatter = settings.scatter_of_stiffness.value_or(0.0);
  if (settings.dry_friction)
    baseline.friction = DryFriction{*settings.dry_friction, needed(settings.dry_friction_stddev, "dry_friction_stddev"),
                                    needed(settings.friction_damping_gain, "friction_damping_gain"),
                                    settings.friction_damping_covariance.value_or(0.0)};
  if (!settings.friction_damping_covariance) widen(baseline);
  if (settings.celsius)
    baseline.temperature = DamperTemperature{*settings.celsius, needed(settings.per_kelvin, "damping_per_kelvin"),
                                             needed(settings.per_kelvin_stddev, "damping_per_kelvin_stddev")};
  baseline.learned = true;
  baseline.from = fromSeconds(settings.learned_from.value_or(0.0));
  baseline.to = fromSeconds(settings.learned_to.value_or(0.0));
  return baseline;
}

// Damage as large as its error threshold must be significant against a baseline: else it could never be proved.
void checkCertain(const char* name, double value, double stddev, double error) {
  if (stddev / value * kCertain <= std::log1p(error)) return;
  throw std::runtime_error(formatted(
      "too uncertain to judge by: %s = %.3g +- %.3g, so that damage of %.3g %% would not be significant; drive "
      "on, or use a rougher road",
      name, value, stddev, 100.0 * error));
}

}  // namespace

std::string toYaml(const Baseline& baseline, double horizon, double sample_period) {
  BaselineSettings settings;
  static_cast<Baseline&>(settings) = baseline;
  if (baseline.damping_scatter > 0.0) settings.scatter_of_damping = baseline.damping_scatter;
  if (baseline.stiffness_scatter > 0.0) settings.scatter_of_stiffness = baseline.stiffness_scatter;
  if (baseline.friction) {
    settings.dry_friction = baseline.friction->force;
    settings.dry_friction_stddev = baseline.friction->stddev;
    settings.friction_damping_gain = baseline.friction->damping_gain;
    settings.friction_damping_covariance = baseline.friction->damping_covariance;
  }
  if (baseline.temperature) {
    settings.celsius = baseline.temperature->celsius;
    settings.per_kelvin = baseline.temperature->per_kelvin;
    settings.per_kelvin_stddev = baseline.temperature->per_kelvin_stddev;
  }
  settings.integration_horizon = horizon;
  settings.sample_period = sample_period;
  settings.learned_from = toSeconds(baseline.from);
  settings.learned_to = toSeconds(baseline.to);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(17) << "# The healthy strut, written by the monitor.\n";
  for (const auto& field : kBaselineFields)
    if (const std::optional<OptionValue> value = option_table::valueOf(option_table::bind(field, settings)))
      text << field.name << ": " << std::get<double>(*value) << "  # [" << field.unit << "] " << field.help << '\n';
  return text.str();
}

Baseline takeBaseline(OptionMap& values) {
  BaselineSettings settings;
  takeOptions(values, kBaselineFields, settings);
  refuseUnknown(values, describeOptions(kBaselineFields));
  return toBaseline(settings);
}

bool areSettings(const OptionMap& values) {
  return std::any_of(values.begin(), values.end(), [](const auto& value) {
    const std::size_t place = value.first.find("nominal/");
    return place == 0 || (place != std::string::npos && value.first[place - 1] == '/');
  });
}

void requireOneReference(const std::string& file, const MonitorOptions& options) {
  if (options.nominal_damping_to_mass || options.nominal_stiffness_to_mass)
    throw std::invalid_argument(
        (file.empty() ? "a baseline" : "baseline_file = \"" + file + '"') +
        " and nominal values are both given, must be one of them: take nominal, which identify -o writes, "
        "out of the settings, or the baseline");
}

LiveBaseline::LiveBaseline(const PipelineOptions& options) : path_(options.shell.baseline_file) {
  if (path_.empty()) return;
  requireOneReference(path_, options.monitor);
  const std::string folder = std::filesystem::path(path_).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw std::invalid_argument("baseline_file = \"" + path_ + "\": there is no folder " + folder);
  if (!std::filesystem::exists(path_)) return;
  OptionMap values = readYaml(path_);
  if (areSettings(values))
    throw std::invalid_argument(path_ +
                                ": these are settings with nominal values, to be given as --config or config:=");
  known_ = prefixed(path_ + ": ", [&] { return takeBaseline(values); });
}

std::string LiveBaseline::reference(const MonitorOptions& options) const {
  if (known_) return "the baseline of " + path_;
  if (options.nominal_damping_to_mass || options.nominal_stiffness_to_mass) return "nominal values";
  return options.learn_time > 0.0 ? formatted("a baseline that %g s of driving make", options.learn_time) : "nothing";
}

std::string LiveBaseline::keepLearned(const SuspensionMonitor& monitor) {
  if (known_ || !monitor.baseline().learned) return {};
  known_ = monitor.baseline();
  if (path_.empty()) return "baseline learned, until the monitor ends: baseline_file would keep it";
  write(*known_, monitor);
  return "baseline learned and written to " + path_;
}

void LiveBaseline::save(const SuspensionMonitor* monitor) {
  if (monitor == nullptr || !monitor->report().estimate.tellsChanges()) throw std::runtime_error(kNothingToSave);
  if (path_.empty()) throw std::runtime_error("no file to write to: start with the parameter baseline_file");
  const StrutEstimate& estimate = monitor->report().estimate;
  const MonitorOptions& options = monitor->options();
  checkCertain("damping_to_mass", estimate.damping_to_mass, estimate.damping_to_mass_stddev, options.damping_error);
  checkCertain("stiffness_to_mass", estimate.stiffness_to_mass, estimate.stiffness_to_mass_stddev,
               options.stiffness_error);
  const Baseline present = baselineOf(estimate, monitor->report().stamp);
  write(present, *monitor);
  known_ = present;
}

void LiveBaseline::write(const Baseline& baseline, const SuspensionMonitor& monitor) const {
  TextFile(path_).commit(toYaml(baseline, monitor.horizonSamples() * monitor.period(), monitor.period()));
}

}  // namespace suspension_health_monitor
