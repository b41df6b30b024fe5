#include "suspension_health_monitor/identify.h"

#include <stdexcept>

#include "suspension_health_monitor/internal/fit/rough_strut.h"
#include "suspension_health_monitor/internal/monitor/drive_identification.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_pipeline.h"

namespace suspension_health_monitor {
namespace {

int proposeHorizon(const std::vector<Drive>& drives, double period) {
  if (const auto rough = roughStrut(drives, period)) return rough->horizonSamples(period);
  throw std::invalid_argument("horizon_samples is not given, and none can be proposed: the data show no damped spring");
}

}  // namespace

IdentifyResult identify(const std::vector<Drive>& drives, const IdentifyOptions& options) {
  MonitorOptions monitor;
  monitor.sample_period = options.sample_period ? *options.sample_period : medianPeriod(drives);
  monitor.memory = options.memory;
  const double period = *monitor.sample_period;
  const int horizon = options.horizon_samples ? *options.horizon_samples : proposeHorizon(drives, period);
  monitor.integration_horizon = horizon * period;
  monitor.alignment = "paired";
  constexpr Stamp kLater(1);  // 0 is the stamp that a driver has not set; a drive may begin with it
  const auto give = [&](const MonitorReport& later) {
    if (!options.report) return;
    MonitorReport report = later;
    report.stamp -= kLater;
    report.comparison.stamp -= kLater;
    options.report(report);
  };
  VehiclePipeline strut(monitor, give);
  for (const Drive& drive : drives)
    for (const CornerSample& sample : drive.samples) {
      strut.push(Side::kSprung, sample.stamp + kLater, sample.sprung_acceleration);
      strut.push(Side::kUnsprung, sample.stamp + kLater, sample.unsprung_acceleration);
    }
  return identified(*strut.strut(), strut.overTheDrive(), strut.rejected());
}

}  // namespace suspension_health_monitor
