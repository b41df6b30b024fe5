#include "suspension_health_monitor/internal/drive_identification.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "suspension_health_monitor/internal/health/sensor_check.h"
#include "suspension_health_monitor/internal/monitor/validity_gate.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kInterval = 1.96;  // standard deviations either way: 95 %

IdentifiedStrut atTheEnd(const StrutEstimate& estimate) {
  IdentifiedStrut strut{estimate.damping_to_mass,
                        estimate.stiffness_to_mass,
                        estimate.damping_to_mass_stddev,
                        estimate.stiffness_to_mass_stddev,
                        estimate.effective_rows,
                        estimate.explained,
                        estimate.valid(),
                        {}};
  if (!strut.valid) strut.reason = describe(estimate.doubt);
  return strut;
}

bool isAboveZero(double value, double stddev) { return value > kInterval * stddev; }

}  // namespace

std::optional<std::string> periodWarning(const SuspensionMonitor& monitor) {
  if (monitor.input().period_fits) return std::nullopt;
  char text[200];
  std::snprintf(text, sizeof text,
                "stamps come every %.6g s, but sample_period = %.6g [s]: no estimate is valid; leave sample_period out "
                "to have it measured",
                monitor.input().mean_period, monitor.period());
  return text;
}

DriveIdentification::DriveIdentification(const MonitorOptions& options, const GridOptions& grid, Sink sink)
    : grid_(*options.sample_period, grid),
      monitor_(options),
      whole_drive_(std::in_place, options.filter(*options.sample_period)),
      sink_(std::move(sink)) {
  if (grid.has_road) tyre_.emplace(options);
}

void DriveIdentification::setEffects(const std::vector<ActiveEffect>& effects) {
  monitor_.setEffects(effects);
  if (!effects.empty()) whole_drive_.reset();
}

void DriveIdentification::push(Side side, Stamp stamp, double acceleration) {
  for (auto sample = grid_.push(side, stamp, acceleration); sample; sample = grid_.next()) take(*sample);
}

void DriveIdentification::take(const CornerSample& sample) {
  if (tyre_) {
    tyre_->setPeriodFits(monitor_.input().period_fits);
    tyre_->add(sample, grid_.roadAcceleration());
  }
  const InputStatus before = monitor_.input();
  const MonitorReport* report = monitor_.addSample(sample);
  if (report != nullptr && sink_) sink_(*report);
  const InputStatus& now = monitor_.input();
  if (!whole_drive_ || now.samples == before.samples) return;  // the monitor has rejected it
  if (now.gaps + now.restarts > before.gaps + before.restarts) whole_drive_->interrupt();
  whole_drive_->push(sample);
}

IdentifiedStrut DriveIdentification::overTheDrive() const {
  IdentifiedStrut strut;
  if (!whole_drive_) {
    strut.reason = "instrumental variables know no effects";
    return strut;
  }
  strut.explained = whole_drive_->explained();
  const std::optional<BlockSolution> solution = whole_drive_->solution();
  if (solution) {
    strut.damping_to_mass = solution->theta[kDampingToMass];
    strut.stiffness_to_mass = solution->theta[kStiffnessToMass];
    strut.damping_to_mass_stddev = solution->stddev[kDampingToMass];
    strut.stiffness_to_mass_stddev = solution->stddev[kStiffnessToMass];
    strut.rows = solution->rows;
  }
  EstimateFacts facts;
  facts.period_fits = monitor_.input().period_fits;
  facts.has_row = solution.has_value();
  facts.rows = strut.rows;
  facts.fewest_rows = kFewestRows;
  facts.explained = strut.explained;
  facts.is_physical = isAboveZero(strut.damping_to_mass, strut.damping_to_mass_stddev) &&
                      isAboveZero(strut.stiffness_to_mass, strut.stiffness_to_mass_stddev);
  facts.has_stddev = std::isfinite(strut.damping_to_mass_stddev + strut.stiffness_to_mass_stddev);
  const EstimateDoubt doubt = doubtOf(facts);
  strut.valid = doubt == EstimateDoubt::kNone;
  if (!strut.valid) strut.reason = describe(doubt);
  return strut;
}

RejectCounts DriveIdentification::rejected() const {
  RejectCounts all = grid_.rejected();
  all += monitor_.rejected();
  return all;
}

IdentifyResult DriveIdentification::result() const {
  IdentifyResult result;
  result.sample_period = monitor_.period();
  result.horizon_samples = monitor_.horizonSamples();
  result.ls = atTheEnd(monitor_.report().ls);
  result.la = atTheEnd(monitor_.report().la);
  result.iv = overTheDrive();
  result.samples = monitor_.input().samples;
  result.rows = monitor_.input().rows;
  result.gaps = monitor_.input().gaps;
  result.clock_jumps = monitor_.input().restarts;
  const RejectCounts counts = rejected();
  for (std::size_t i = 0; i < kRejectReasonNames.size(); ++i)
    if (const std::uint64_t count = counts.count(static_cast<RejectReason>(i)))
      result.rejected[std::string(kRejectReasonNames[i])] = count;
  if (const auto warning = periodWarning(monitor_)) result.warnings.push_back(*warning);
  const SensorReport& sensor = monitor_.report().health.sensor;
  if (sensor.fault != SensorFault::kNone && sensor.fault != SensorFault::kUnrelated)
    result.warnings.push_back(describe(sensor));
  return result;
}

}  // namespace suspension_health_monitor
