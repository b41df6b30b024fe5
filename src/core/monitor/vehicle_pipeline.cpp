#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

namespace {

VehiclePipeline::Sinks sinksOf(std::function<void(const MonitorReport&)> report) {
  if (!report) return {};
  return {[report = std::move(report)](std::size_t, const MonitorReport& of_strut) { report(of_strut); }, {}};
}

}  // namespace

VehiclePipeline::VehiclePipeline(const std::vector<MonitorSettings>& settings, const VehicleStreams& streams,
                                 Sinks sinks)
    : streams_(streams),
      sinks_(std::move(sinks)),
      monitor_(settings, sinks_.report, static_cast<int>(streams.channels.known_forces.size())),
      first_readings_(mapped(streams.sensors, [&](const auto& its) { return streams.options[its.stream].required; })) {
  if (settings.front().sample_period) start();
}

VehiclePipeline::VehiclePipeline(const MonitorSettings& settings, std::function<void(const MonitorReport&)> report)
    : VehiclePipeline({settings}, VehicleStreams(VehicleLayout::ofOneStrut(settings.tyre)),
                      sinksOf(std::move(report))) {}

void VehiclePipeline::start() {
  const MonitorSettings& settings = monitor_.settings();
  const double period = *settings.sample_period;
  grid_.emplace(
      period, streams_, settings.grid(period), [this](const VehicleSample& sample) { take(sample); },
      [this](const VehicleReading& reading) { monitor_.addReading(grid_->vehicle(), reading); });
  if (streams_.channels.road) tyre_.emplace(settings);
}

void VehiclePipeline::push(std::size_t sensor, Stamp stamp, const double* values) {
  if (is_refused_) return;
  if (grid_ && first_readings_.isEmpty()) {
    grid_->push(sensor, stamp, values);
    return;
  }
  const FirstReadings::Reading reading{sensor, stamp, {values, values + streams_.sensors[sensor].count}};
  if (grid_) {  // a sink has thrown while they were replayed
    first_readings_.append(reading);
  } else {
    const std::optional<double> period = first_readings_.add(reading);
    if (!period) return;
    startOnce(*period);
  }
  // A sink may throw; readings that come after those that it has seen wait for the next push().
  while (const auto first = first_readings_.next()) grid_->push(first->stream, first->stamp, first->values);
}

// Settings that do not fit what was measured will not fit it at the next reading either: that is said once.
void VehiclePipeline::startOnce(double period) {
  try {
    monitor_.begin(period);
    start();
  } catch (const std::invalid_argument&) {
    is_refused_ = true;
    grid_.reset();
    throw;
  }
}

void VehiclePipeline::finish() {
  if (grid_) grid_->finish();
}

void VehiclePipeline::take(const VehicleSample& sample) {
  newest_ = sample.stamp;
  if (tyre_) {
    tyre_->setPeriodFits(monitor_.strut(0)->input().period_fits);
    tyre_->add(sample.ofStrut(0), std::isnan(sample.road) ? std::nullopt : std::optional(sample.road));
  }
  monitor_.addGridSample(sample);
  if (sinks_.sample) sinks_.sample(sample);
}

RejectCounts VehiclePipeline::rejected(std::size_t sensor) const {
  RejectCounts all = first_readings_.rejected(sensor);
  if (grid_) all += grid_->rejected(sensor);
  return all;
}

RejectCounts VehiclePipeline::rejected() const {
  RejectCounts all;
  for (std::size_t i = 0; i < streams_.sensors.size(); ++i) all += rejected(i);
  for (std::size_t i = 0; i < monitor_.numStruts(); ++i)
    if (strut(i) != nullptr) all += strut(i)->rejected();
  return all;
}

}  // namespace suspension_health_monitor
