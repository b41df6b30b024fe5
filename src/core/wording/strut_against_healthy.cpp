#include <cmath>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

std::optional<LogChange> changeOf(double value, double stddev, const std::optional<double>& healthy,
                                  double healthy_stddev) {
  if (!healthy || !(value > 0.0)) return std::nullopt;
  return LogChange{std::log(value / *healthy), std::hypot(stddev / value, healthy_stddev / *healthy)};
}

}  // namespace

std::optional<StrutOfDrive> strutOf(const IdentifyResult& found) {
  const double horizon = found.horizon_samples * found.sample_period;
  if (found.estimate.valid && found.isSteady()) return StrutOfDrive{found.estimate, "over the whole drive", horizon};
  if (found.now.valid) return StrutOfDrive{found.now, "at the end of the drive", horizon};
  return std::nullopt;
}

Baseline nominalOf(const MonitorOptions& options) {
  Baseline nominal;
  nominal.damping_to_mass = options.nominal_damping_to_mass;
  nominal.stiffness_to_mass = options.nominal_stiffness_to_mass;
  return nominal;
}

std::string describeChange(const StrutOfDrive& found, const Baseline& healthy, const MonitorOptions& options) {
  const IdentifiedStrut& strut = found.strut;
  const MeasuredChange measured{changeOf(strut.damping_to_mass, strut.damping_to_mass_stddev, healthy.damping_to_mass,
                                         healthy.damping_to_mass_stddev),
                                changeOf(strut.stiffness_to_mass, strut.stiffness_to_mass_stddev,
                                         healthy.stiffness_to_mass, healthy.stiffness_to_mass_stddev)};
  const StrutChange change = splitChange(measured, options.payload_range, 0.0);
  const std::string text = describe(change, healthy);
  return text.empty() ? "" : "the strut, " + found.by + ": " + text;
}

std::string describeChange(const IdentifyResult& found, const Baseline& healthy, const MonitorOptions& options) {
  const std::optional<StrutOfDrive> strut = strutOf(found);
  return strut ? describeChange(*strut, healthy, options) : "";
}

std::string describeChange(const std::vector<Drive>& drives, const DiagnoseOptions& searched, const Baseline& healthy,
                           const MonitorOptions& options) {
  if (healthy.isEmpty()) return "";
  IdentifyOptions identifying;
  identifying.sample_period = searched.sample_period;
  identifying.horizon_samples = searched.horizon_samples;
  identifying.memory = options.memory;
  return describeChange(identify(drives, identifying), healthy, options);
}

}  // namespace suspension_health_monitor
