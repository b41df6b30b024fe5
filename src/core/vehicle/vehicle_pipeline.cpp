#include "suspension_health_monitor/internal/vehicle/vehicle_pipeline.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/monitor/drive_identification.h"
#include "suspension_health_monitor/internal/text.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {

VehicleCoupling couplingOf(const VehicleMonitor& monitor, const std::vector<std::string>& names,
                           const std::vector<std::string>& forces) {
  if (monitor.isCoupled() && monitor.rows() == nullptr) {  // a strut alone
    VehicleCoupling alone;
    alone.ratios = {{1.0}};
    alone.stddevs = {{0.0}};
    return alone;
  }
  const BodyRows* rows = monitor.rows();
  return describe(rows, monitor.body(), rows == nullptr ? whyNotCoupled(monitor.mistake(), names) : "", forces);
}

std::string describeMistake(const VehicleMonitor& monitor, const std::vector<std::string>& names) {
  const std::string mistake = describe(monitor.mistake(), names);
  return mistake.empty() ? "" : "the drives do not fit the vehicle file: " + mistake;
}

VehicleIdentification identified(VehicleMonitor& monitor, const std::vector<std::string>& names,
                                 const std::vector<std::string>& forces) {
  VehicleIdentification result{couplingOf(monitor, names, forces), {}};
  for (std::size_t i = 0; result && i < names.size(); ++i)
    result.struts.push_back(identified(*monitor.strut(i), monitor.overTheDrive(i), monitor.strut(i)->rejected()));
  if (const std::string mistake = describeMistake(monitor, names); !mistake.empty())
    for (IdentifyResult& strut : result.struts) strut.warnings.push_back(mistake);
  return result;
}

namespace {

std::vector<bool> requiredOf(const VehicleStreams& streams) {
  std::vector<bool> required;
  for (const VehicleStreams::Sensor& sensor : streams.sensors)
    required.push_back(streams.options[sensor.stream].required);
  return required;
}

VehiclePipeline::Sinks sinksOf(std::function<void(const MonitorReport&)> report) {
  if (!report) return {};
  return {[report = std::move(report)](std::size_t, const MonitorReport& of_strut) { report(of_strut); }, {}};
}

}  // namespace

VehiclePipeline::VehiclePipeline(const std::vector<MonitorSettings>& settings, const VehicleStreams& streams,
                                 Sinks sinks)
    : starts_(settings.begin(), settings.end()),
      streams_(streams),
      sinks_(std::move(sinks)),
      early_(requiredOf(streams), kMostWaiting) {
  for (const MonitorSettings& each : settings) each.validate();
  if (settings.front().sample_period) start(*settings.front().sample_period);
}

VehiclePipeline::VehiclePipeline(const MonitorSettings& settings, std::function<void(const MonitorReport&)> report)
    : VehiclePipeline({settings}, VehicleStreams(VehicleLayout::ofOneStrut(settings.tyre)),
                      sinksOf(std::move(report))) {}

void VehiclePipeline::start(double period) {
  for (VehicleMonitor::Start& start : starts_) start.settings.sample_period = period;
  const MonitorSettings& settings = starts_.front().settings;
  monitor_.emplace(starts_, sinks_.report, static_cast<int>(streams_.channels.known_forces.size()));
  grid_.emplace(
      period, streams_, settings.grid(period), [this](const VehicleSample& sample) { take(sample); },
      [this](const VehicleReading& reading) { monitor_->addReading(grid_->vehicle(), reading); });
  if (streams_.channels.road) tyre_.emplace(settings);
}

void VehiclePipeline::setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& start,
                                 std::size_t strut) {
  requireUsable(effects);
  if (monitor_) return monitor_->setEffects(strut, effects, start);
  starts_[strut].effects = effects;
  starts_[strut].strut = start;
}

void VehiclePipeline::setBaseline(const Baseline& baseline, std::size_t strut) {
  for (const auto& [name, value] : {std::pair("baseline damping_to_mass", baseline.damping_to_mass),
                                    std::pair("baseline stiffness_to_mass", baseline.stiffness_to_mass)})
    if (value) requireAboveZero(name, *value, "");
  starts_[strut].baseline = baseline;
  if (monitor_) monitor_->setBaseline(strut, baseline);
}

Baseline VehiclePipeline::baseline(std::size_t strut) const {
  const SuspensionMonitor* monitor = this->strut(strut);
  return monitor != nullptr ? monitor->baseline() : starts_[strut].baseline.value_or(Baseline{});
}

void VehiclePipeline::reconfigure(const MonitorSettings& settings, std::size_t strut) {
  MonitorSettings changed = settings;
  changed.sample_period = period();
  if (monitor_) monitor_->reconfigure(strut, changed);
  starts_[strut].settings = changed;
}

void VehiclePipeline::push(std::size_t sensor, Stamp stamp, const double* values) {
  if (is_refused_) return;
  if (monitor_ && early_.isEmpty()) {
    grid_->push(sensor, stamp, values);
    return;
  }
  const VehicleStreams::Sensor& its = streams_.sensors[sensor];
  const std::size_t next =
      sensor + 1 < streams_.sensors.size() ? streams_.sensors[sensor + 1].stream : streams_.options.size();
  const EarlyReadings<std::vector<double>>::Reading reading{sensor, stamp, {values, values + (next - its.stream)}};
  if (monitor_) {  // a sink has thrown while they were replayed
    early_.append(reading);
  } else {
    const std::optional<double> period = early_.add(reading);
    if (!period) return;
    startOnce(*period);
  }
  replayEarly();
}

// Settings that do not fit what was measured will not fit it at the next reading either: that is said once.
void VehiclePipeline::startOnce(double period) {
  try {
    start(period);
  } catch (const std::invalid_argument&) {
    is_refused_ = true;
    monitor_.reset();
    grid_.reset();
    throw;
  }
}

// A sink may throw; readings that come after those that it has seen wait for the next push().
void VehiclePipeline::replayEarly() {
  while (const auto reading = early_.next()) grid_->push(reading->stream, reading->stamp, reading->value);
}

void VehiclePipeline::finish() {
  if (grid_) grid_->finish();
}

void VehiclePipeline::take(const VehicleSample& sample) {
  newest_ = sample.stamp;
  road_ = sample.road;
  if (tyre_) {
    tyre_->setPeriodFits(monitor_->strut(0)->input().period_fits);
    tyre_->add(sample.ofStrut(0), std::isnan(road_) ? std::nullopt : std::optional(road_));
  }
  monitor_->addGridSample(sample);
  if (sinks_.sample) sinks_.sample(sample);
}

RejectCounts VehiclePipeline::rejected(std::size_t sensor) const {
  RejectCounts all = early_.rejected(sensor);
  if (grid_) all += grid_->rejected(sensor);
  return all;
}

RejectCounts VehiclePipeline::rejected() const {
  RejectCounts all;
  for (std::size_t i = 0; i < streams_.sensors.size(); ++i) all += rejected(i);
  for (std::size_t i = 0; i < starts_.size(); ++i)
    if (strut(i) != nullptr) all += strut(i)->rejected();
  return all;
}

}  // namespace suspension_health_monitor
