#include "recorded_drives.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <optional>
#include <utility>

#include "../ros/conversions.h"
#include "../ros/model_file.h"
#include "../ros/vehicle_sensors.h"
#include "command.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/signal/tuning.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

/// @return L, if the settings of a strut give the horizon.
std::optional<int> givenHorizon(const BagOptions& options, std::size_t strut) {
  const MonitorOptions& settings = options.settings.struts[strut].monitor;
  if (!settings.integration_horizon) return std::nullopt;
  return MonitorSettings(settings).horizonSamples(options.period());
}

void requireCoupling(const VehicleCoupling& coupling) {
  if (!coupling) throw TooLittleError("the drives " + coupling.reason);
}

}  // namespace

ReadSamples readSamples(const ImuBags& bags, const PipelineOptions& options, VehicleLayout layout,
                        const SampleSinks& take) {
  layout.road_imu.reset();
  const VehicleStreams streams(layout);
  VehicleSensors sensors(streams, options.shell, bags.transforms.get());
  const double period = *options.monitor.sample_period;
  bool goes_on = true;
  VehicleGrid grid(period, streams, MonitorSettings(options.monitor).grid(period),
                   [&](const VehicleSample& sample) { goes_on = goes_on && take.sample(sample); });
  const auto push = [&](std::size_t sensor, Stamp stamp, const std::vector<double>& values) {
    if (grid.push(sensor, stamp, values) && take.take_back) take.take_back();
    return goes_on;
  };
  const bool has_body = take.body && layout.struts.size() == 1;
  Stamp last_body{};
  const auto take_imu = [&](std::size_t sensor, const sensor_msgs::Imu& imu, Stamp) {
    if (sensor >= streams.sensors.size()) return true;  // that of the road
    const std::vector<double>& values = sensors.read(sensor, imu);
    if (values.empty()) return true;
    const Stamp stamp = toStamp(imu.header.stamp);
    if (has_body && sensor == streams.bodyImuOf(0) && stamp > last_body) {
      last_body = stamp;
      take.body(sensors.mount(sensor).across(imu));
    }
    return push(sensor, stamp, values);
  };
  const auto take_wrench = [&](std::size_t sensor, const geometry_msgs::WrenchStamped& wrench, Stamp) {
    return push(sensor, toStamp(wrench.header.stamp), sensors.read(sensor, wrench));
  };
  readTopics(bags, {take_imu, take_wrench});
  grid.finish();
  std::vector<RejectCounts> rejected;
  for (std::size_t i = 0; i < streams.sensors.size(); ++i) {
    rejected.push_back(sensors.rejected(i));
    rejected.back() += grid.rejected(i);
  }
  return {std::move(grid), rejected, sensors.mountFaults(namesOf(bags.topics))};
}

RecordedDrives readDrives(BagOptions& options, TopicGaps& gaps) {
  RecordedDrives recorded;
  VehicleLayout& layout = options.vehicle.layout;
  for (const std::string& path : options.bags.paths) {
    VehicleDrive& drive = recorded.drives.emplace_back();
    drive.struts.resize(layout.struts.size());
    for (const VehicleLayout::KnownForce& force : layout.known_forces) drive.forces.push_back({force.name, {}});
    SampleSinks take;
    take.sample = [&](const VehicleSample& sample) {
      append(sample, drive);
      return true;
    };
    take.body = [&](const BodyMotion& motion) { drive.struts.front().body.push_back(motion); };
    take.take_back = [&] { dropNewest(drive, kSignalTuning.outcomes); };
    recorded.bags.push_back(readSamples(options.bags.of(path, gaps), options.settings.common, layout, take));
    const VehicleGrid& grid = recorded.bags.back().grid;
    dropBefore(grid.streams().settled(), drive);
    grid.describe(drive);
    drive.places = grid.vehicle().places();
  }
  layout.turn(recorded.bags.front().grid.bodyLevel().mount);
  return recorded;
}

void printBags(const BagOptions& options, const std::vector<ReadSamples>& bags, const TopicGaps& gaps) {
  gaps.print();
  printPeriod(options, options.period());
  for (const ReadSamples& bag : bags) printReadings(bag.grid, options.bags, bag.rejected);
}

void printPeriod(const BagOptions& options, double period) {
  std::printf("sample period %.6g s%s\n", period, options.period_measured ? " (measured)" : "");
}

void printReadings(const VehicleGrid& grid, const ImuBags& bags, const std::vector<RejectCounts>& rejected) {
  std::printf("%" PRIu64 " instants, readings %s\n", grid.numInstants(), describeAlignment(grid.streams()).c_str());
  const std::string leans = describe(grid.bodyLevel());
  if (!leans.empty()) std::printf("%s\n", leans.c_str());
  for (std::size_t i = 0; i < rejected.size(); ++i)
    if (rejected[i].total() > 0)
      std::printf("%s%s\n", bags.topics[i].name.c_str(), describeRejected(rejected[i]).c_str());
}

void requireEnough(Shortcoming shortcoming, const std::string& reason, const std::string& prefix) {
  if (shortcoming == Shortcoming::kModelUntestable) throw InputError(prefix + "the drives " + reason);
  if (shortcoming != Shortcoming::kNone) throw TooLittleError(prefix + "the drives " + reason);
}

AskedDrives::AskedDrives(const po::variables_map& values)
    : library(readEffectsFile(values[kEffectsFile].as<std::string>())),
      models(readModels(values, readVehicle(values), library)),
      options(readBagOptions(values)),
      gaps(options.settings.common.shell.input_timeout) {}

void AskedDrives::read() {
  recorded = readDrives(options, gaps);
  for (const std::string& fault : recorded.bags.front().mount_faults)
    if (!fault.empty()) gaps.add(fault);
}

RecordedComparison compareBags(const AskedDrives& asked, const std::function<void(double)>& progress) {
  const AskedVehicle& vehicle = asked.options.vehicle;
  const SeparatedVehicle own =
      separateVehicle(asked.recorded.drives, vehicle.names, asked.options.period(), asked.models);
  asked.gaps.explain([&] { requireCoupling(own.coupling); });
  RecordedComparison result{own.coupling, std::vector<Comparison>(vehicle.names.size())};
  double done = 0.0;
  for (const std::size_t i : vehicle.asked) {
    CompareOptions comparing;
    comparing.sample_period = asked.options.period();
    comparing.horizon_samples = givenHorizon(asked.options, i);
    comparing.model = asked.models[i];
    comparing.fit = !asked.models[i];
    comparing.progress = [&](double share) { progress((done + share) / static_cast<double>(vehicle.asked.size())); };
    const Comparison& found = result.struts[i] = compare(own.struts[i], comparing);
    done += 1.0;
    asked.gaps.explain([&] { requireEnough(found.shortcoming, found.reason, vehicle.prefix(i, ": ")); });
  }
  return result;
}

VehicleDiagnosis diagnoseBags(const AskedDrives& asked, DiagnoseOptions& searching) {
  searching.sample_period = asked.options.period();
  searching.candidates = asked.library;
  const AskedVehicle& vehicle = asked.options.vehicle;
  std::vector<DiagnoseOptions> by_strut(vehicle.names.size(), searching);
  for (std::size_t i = 0; i < by_strut.size(); ++i) {
    by_strut[i].horizon_samples = givenHorizon(asked.options, i);
    by_strut[i].model = asked.models[i];
  }
  VehicleDiagnosis found = diagnoseVehicle(asked.recorded.drives, vehicle.names, by_strut, asked.models);
  asked.gaps.explain([&] {
    requireCoupling(found.coupling);
    const auto isFound = [&](std::size_t i) { return static_cast<bool>(found.struts[i]); };
    if (std::any_of(vehicle.asked.begin(), vehicle.asked.end(), isFound)) return;
    const std::size_t first = vehicle.asked.front();
    requireEnough(found.struts[first].shortcoming, found.struts[first].reason, vehicle.prefix(first, ": "));
  });
  return found;
}

std::vector<std::string> changesOf(const AskedDrives& asked) {
  const BagOptions& options = asked.options;
  const std::vector<PipelineOptions>& settings = options.settings.struts;
  const HealthyStruts known = beforehand({}, options);
  std::vector<Baseline> healthy;
  std::vector<IdentifyOptions> identifying(settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    healthy.push_back(knownHealthy(known[i], settings[i]));
    identifying[i].sample_period = options.period();
    identifying[i].horizon_samples = givenHorizon(options, i);
    identifying[i].memory = settings[i].monitor.memory;
  }
  std::vector<std::string> changes(settings.size());
  if (std::all_of(healthy.begin(), healthy.end(), [](const Baseline& strut) { return strut.isEmpty(); }))
    return changes;
  const VehicleIdentification found = identifyVehicle(asked.recorded.drives, options.vehicle.names, identifying);
  for (std::size_t i = 0; i < changes.size(); ++i)
    changes[i] = describeChange(found.struts[i], healthy[i], settings[i].monitor);
  return changes;
}

}  // namespace suspension_health_monitor
