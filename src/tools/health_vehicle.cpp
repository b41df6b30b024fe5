#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../ros/live_baseline.h"
#include "../ros/live_model.h"
#include "../ros/vehicle_options.h"
#include "command.h"
#include "errors.h"
#include "health_page.h"
#include "health_results.h"
#include "long_work.h"
#include "recorded_vehicle.h"
#include "report_page.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/prefixed.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"
#include "vehicle_commands.h"
#include "vehicle_tables.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

/// What a strut is watched with, as live.
struct WatchedStrut {
  LiveModel model;
  std::optional<Baseline> healthy;  ///< of a file
  std::string file;                 ///< that file
};

/// Reads the files of all struts; that of --baseline takes the place of baseline_file.
std::vector<WatchedStrut> readWatched(const po::variables_map& values, const AskedVehicle& vehicle,
                                      VehicleOptions& options) {
  std::vector<std::optional<Baseline>> given(vehicle.names.size());
  const std::string file = values.count(kBaseline) != 0 ? values[kBaseline].as<std::string>() : "";
  if (!file.empty()) given = readBaselines(file, vehicle);
  std::vector<WatchedStrut> watched;
  for (std::size_t i = 0; i < given.size(); ++i) {
    PipelineOptions& its = options.struts[i];
    prefixed("struts/" + vehicle.names[i] + ": ", [&] {
      if (given[i]) {
        its.shell.baseline_file = file;
        requireOneReference(its);
        watched.push_back({LiveModel(its.shell), given[i], file});
      } else {
        watched.push_back({LiveModel(its.shell), LiveBaseline(its).known(), its.shell.baseline_file});
      }
    });
  }
  return watched;
}

/// The monitor of VehicleNodelet over recorded drives, with a log for every strut.
class WatchedVehicle {
 public:
  /// @param row  called as HealthLog calls its sink, with what the strut is judged by then.
  WatchedVehicle(const VehicleOptions& options, const std::vector<WatchedStrut>& watched, const VehicleDrive& first,
                 const std::function<void(std::size_t strut, const HealthMoment&, const Baseline&)>& row)
      : monitor_(
            settingsOf(options),
            [this](std::size_t strut, const MonitorReport& report) { logs_[strut].addReport(report); },
            static_cast<int>(first.forces.size()), first.noise) {
    for (std::size_t i = 0; i < watched.size(); ++i) {
      const LiveModel& model = watched[i].model;
      monitor_.setEffects(i, model.effects(), model.strutFor(model.effects()));
      if (watched[i].healthy) monitor_.setBaseline(i, *watched[i].healthy);
      logs_.emplace_back(fromSeconds(options.common.shell.input_timeout), [this, i, row](const HealthMoment& moment) {
        row(i, moment, monitor_.isCoupled() ? monitor_.strut(i)->baseline() : Baseline{});
      });
    }
  }
  WatchedVehicle(const WatchedVehicle&) = delete;  // its sinks refer to it
  WatchedVehicle& operator=(const WatchedVehicle&) = delete;

  /// Takes in the drives, one after the other.
  /// @return the time elapsed when each begins.
  /// @throws TooLittleError  if they do not tell how the struts move one another.
  std::vector<Stamp> read(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names) {
    std::vector<Stamp> begins;
    for (const VehicleDrive& drive : drives) {
      begins.push_back(logs_.front().elapsed());
      for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) {
        const VehicleSample sample = sampleOf(drive, k);
        for (HealthLog& log : logs_) log.addReading(sample.stamp, sample.stamp);
        monitor_.addSample(sample);
        Interruption::check();
      }
      for (HealthLog& log : logs_) log.finishRecording();
    }
    if (!monitor_.isCoupled()) throw TooLittleError("the drives " + reasonOf(monitor_.estimate(), names));
    return begins;
  }

  const VehicleMonitor& monitor() const { return monitor_; }
  const HealthLog& log(std::size_t strut) const { return logs_[strut]; }

 private:
  static std::vector<MonitorSettings> settingsOf(const VehicleOptions& options) {
    std::vector<MonitorSettings> settings;
    for (const PipelineOptions& strut : options.struts) settings.emplace_back(strut.monitor);
    return settings;
  }

  std::vector<HealthLog> logs_;
  VehicleMonitor monitor_;
};

}  // namespace

void watchStruts(const po::variables_map& values) {
  const Interruption interruption;
  const AskedVehicle vehicle = readVehicle(values);
  VehicleOptions options = VehicleOptions::fromValues(vehicle.layout, gatherOptions(values));
  const std::vector<WatchedStrut> watched = readWatched(values, vehicle, options);
  HealthFiles files(values, vehicle.only ? std::vector<std::string>{} : vehicle.names);
  const std::vector<VehicleDrive> drives = readDrives(values, vehicle, options.common);
  for (PipelineOptions& strut : options.struts) strut.monitor.sample_period = options.common.monitor.sample_period;
  const auto placeInFiles = [&](std::size_t strut) { return vehicle.only ? 0 : strut; };
  WatchedVehicle recorded(options, watched, drives.front(),
                          [&](std::size_t strut, const HealthMoment& moment, const Baseline& healthy) {
                            if (!vehicle.only || *vehicle.only == strut)
                              files.add(placeInFiles(strut), moment, healthy);
                          });
  const std::vector<Stamp> begins = recorded.read(drives, vehicle.names);

  std::vector<HealthContent::Recording> recordings;
  for (const std::string& name : fileNames(values["bag"].as<std::vector<std::string>>()))
    recordings.push_back({name, begins[recordings.size()]});
  nlohmann::json whole =
      toJson(describe(*recorded.monitor().coupling(), vehicle.names, forceNames(drives.front())), vehicle.names);
  std::vector<HealthContent> contents;
  for (const std::size_t i : vehicle.asked) {
    const SuspensionMonitor& strut = *recorded.monitor().strut(i);
    const std::string reference = describeReference(strut.baseline(), watched[i].healthy ? watched[i].file : "");
    whole["struts"][vehicle.names[i]] = toJson(recorded.log(i), strut);
    contents.push_back(
        {recorded.log(i), files.course(placeInFiles(i)), strut, recordings, reference, vehicle.names[i]});
    std::printf("\n%s, ", vehicle.names[i].c_str());
    printHealth(recorded.log(i), strut, reference);
  }
  files.commit(whole, contents);
}

}  // namespace suspension_health_monitor
