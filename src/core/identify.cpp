#include "suspension_health_monitor/identify.h"

#include <stdexcept>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"
#include "suspension_health_monitor/internal/vehicle/rough_strut.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

StrutEstimate withAbsoluteStddev(StrutEstimate estimate) {
  estimate.damping_to_mass_stddev = estimate.dampingAbsoluteStddev();
  estimate.stiffness_to_mass_stddev = estimate.stiffnessAbsoluteStddev();
  estimate.damping_model_stddev = estimate.stiffness_model_stddev = 0.0;
  return estimate;
}

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

IdentifyResult identified(const SuspensionMonitor& monitor, const StrutEstimate& over_the_drive,
                          const RejectCounts& rejected) {
  IdentifyResult result;
  result.sample_period = monitor.period();
  result.horizon_samples = monitor.horizonSamples();
  result.ls = withAbsoluteStddev(monitor.report().ls);
  result.la = withAbsoluteStddev(monitor.report().la);
  result.estimate = withAbsoluteStddev(over_the_drive);
  result.now = withAbsoluteStddev(monitor.report().estimate);
  result.estimate.age = result.now.age;
  result.estimate.roughest = result.now.roughest;
  result.samples = monitor.input().samples;
  result.rows = monitor.input().rows;
  result.gaps = monitor.input().gaps;
  result.clock_jumps = monitor.input().restarts;
  result.rejected = rejected.byName();
  if (!monitor.input().period_fits)
    result.warnings.push_back(formatted(
        "stamps come every %.6g s, but sample_period = %.6g [s]: ls and la are not valid; leave sample_period "
        "out to have it measured",
        monitor.input().mean_period, monitor.period()));
  const SensorReport& sensor = monitor.report().health.sensor;
  // The warnings about gravity name a wrong axis, with the topic of its IMU.
  if (sensor.fault != SensorFault::kNone && sensor.fault != SensorFault::kUnrelated &&
      sensor.fault != SensorFault::kOtherAxis)
    result.warnings.push_back(describe(sensor));
  if (!result.isSteady()) result.warnings.push_back(describe(*result.estimate.change));
  return result;
}

VehicleCoupling couplingOf(const VehicleMonitor& monitor, const std::vector<std::string>& names,
                           const std::vector<std::string>& forces) {
  if (monitor.rows() != nullptr) return describe(*monitor.rows(), monitor.body(), forces);
  VehicleCoupling coupling;
  if (monitor.isCoupled()) {  // a strut alone
    coupling.ratios = {{1.0}};
    coupling.stddevs = {{0.0}};
  } else {
    coupling.reason = whyNotCoupled(monitor.mistake(), names);
  }
  return coupling;
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

}  // namespace suspension_health_monitor
