#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../ros/conversions.h"
#include "../ros/live_model.h"
#include "../ros/vehicle_options.h"
#include "../ros/vehicle_pipeline.h"
#include "bag_options.h"
#include "command.h"
#include "errors.h"
#include "health_page.h"
#include "health_results.h"
#include "healthy_strut.h"
#include "long_work.h"
#include "recorded_vehicle.h"
#include "report_page.h"
#include "suspension_health_monitor/internal/prefixed.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"
#include "vehicle_bags.h"
#include "vehicle_commands.h"
#include "vehicle_tables.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

/// What a strut is watched with, as live.
struct WatchedStrut {
  LiveModel model;
  std::optional<HealthyStrut> healthy;
};

/// Reads the files of all struts; that of --baseline takes the place of baseline_file.
std::vector<WatchedStrut> readWatched(const po::variables_map& values, const AskedVehicle& vehicle,
                                      VehicleOptions& options) {
  const std::vector<std::optional<HealthyStrut>> healthy = takeHealthy(values, vehicle, options);
  std::vector<WatchedStrut> watched;
  for (std::size_t i = 0; i < healthy.size(); ++i)
    prefixed("struts/" + vehicle.names[i] + ": ", [&] {
      const PipelineOptions& its = options.struts[i];
      watched.push_back({LiveModel(its.shell, options.model_of[i]), beforehand(healthy[i], its)});
    });
  return watched;
}

/// The monitor of VehicleNodelet over recorded drives, with a log for every strut.
class WatchedVehicle {
 public:
  /// @param row  called as HealthLog calls its sink, with what the strut is judged by then.
  WatchedVehicle(const VehicleOptions& options, const VehicleStreams& streams, const std::vector<WatchedStrut>& watched,
                 const tf2::BufferCore* transforms,
                 const std::function<void(std::size_t strut, const HealthMoment&, const Baseline&)>& row)
      : watched_(watched),
        topics_(topicsOf(streams)),
        pipeline_(options, streams, transforms,
                  {[this](VehicleMonitor& monitor) { begin(monitor); },
                   [this](std::size_t strut, const MonitorReport& report) { logs_[strut].addReport(report); }}) {
    for (std::size_t i = 0; i < watched.size(); ++i)
      logs_.emplace_back(fromSeconds(options.common.shell.input_timeout), topics_,
                         [this, i, row](const HealthMoment& moment) { row(i, moment, baselineOf(i)); });
  }
  WatchedVehicle(const WatchedVehicle&) = delete;  // its sinks refer to it
  WatchedVehicle& operator=(const WatchedVehicle&) = delete;

  /// Reads one bag after the other.
  /// @return the time elapsed when each begins.
  std::vector<Stamp> read(const ImuBags& bags) {
    std::vector<Stamp> begins;
    const auto take = [this](std::size_t sensor, const auto& message, Stamp recorded) {
      for (HealthLog& log : logs_) log.addReading(sensor, toStamp(message.header.stamp), recorded);
      pipeline_.push(sensor, message);
      return true;
    };
    for (const std::string& path : bags.paths) {
      begins.push_back(logs_.front().elapsed());
      ImuBags bag = bags;
      bag.paths = {path};
      readTopics(bag, {take, take});
      pipeline_.finish();
      for (HealthLog& log : logs_) log.finishRecording();
    }
    return begins;
  }

  /// Tells people what the bags hold.
  void printInput() const {
    if (pipeline_.monitor() == nullptr) return;
    std::printf("sample period %.6g s\n%llu samples of %zu struts, readings %s\n", *pipeline_.period(),
                static_cast<unsigned long long>(pipeline_.grid()->numInstants()), logs_.size(),
                pipeline_.grid()->streams().describeAlignment().c_str());
    const std::string leans = describe(pipeline_.grid()->bodyLevel());
    if (!leans.empty()) std::printf("%s\n", leans.c_str());
    for (std::size_t i = 0; i < topics_.size(); ++i) printRejected(topics_[i], pipeline_.rejected(i));
  }

  /// @throws TooLittleError  if the drives do not tell how the struts move one another.
  void requireCoupling(const std::vector<std::string>& names) const {
    const VehicleMonitor* monitor = pipeline_.monitor();
    if (monitor == nullptr) throw TooLittleError(describeNoStart("on one of " + join(topics_)));
    if (!monitor->isCoupled()) throw TooLittleError("the drives " + reasonOf(monitor->estimate(), names));
  }

  const VehicleMonitor& monitor() const { return *pipeline_.monitor(); }
  const HealthLog& log(std::size_t strut) const { return logs_[strut]; }

 private:
  void begin(VehicleMonitor& monitor) const {
    for (std::size_t i = 0; i < watched_.size(); ++i) {
      const LiveModel& model = watched_[i].model;
      monitor.setEffects(i, model.effects(), model.strutFor(model.effects()));
      if (watched_[i].healthy) monitor.setBaseline(i, watched_[i].healthy->baseline);
    }
  }

  Baseline baselineOf(std::size_t strut) const {
    const VehicleMonitor* monitor = pipeline_.monitor();
    return monitor != nullptr && monitor->isCoupled() ? monitor->strut(strut)->baseline() : Baseline{};
  }

  const std::vector<WatchedStrut>& watched_;
  std::vector<std::string> topics_;
  std::vector<HealthLog> logs_;
  VehiclePipeline pipeline_;
};

}  // namespace

void watchStruts(const po::variables_map& values) {
  const Interruption interruption;
  AskedVehicle vehicle = readVehicle(values);
  VehicleOptions options = VehicleOptions::fromValues(vehicle.layout, gatherOptions(values));
  const std::vector<WatchedStrut> watched = readWatched(values, vehicle, options);
  HealthFiles files(values, vehicle.only ? std::vector<std::string>{} : vehicle.names);
  TopicGaps gaps(options.common.shell.input_timeout);
  ImuBags bags = readBags(values);
  if (!options.common.shell.target_frame.empty()) bags.transforms = readStaticTransforms(bags.paths);
  const VehicleStreams streams = streamsOf(bags, options.common, vehicle.layout);
  bags.gaps = &gaps;
  const auto placeInFiles = [&](std::size_t strut) { return vehicle.only ? 0 : strut; };
  WatchedVehicle recorded(options, streams, watched, bags.transforms.get(),
                          [&](std::size_t strut, const HealthMoment& moment, const Baseline& healthy) {
                            if (!vehicle.only || *vehicle.only == strut)
                              files.add(placeInFiles(strut), moment, healthy);
                          });
  const std::vector<Stamp> begins = recorded.read(bags);
  recorded.printInput();
  gaps.print();
  gaps.explain([&] { recorded.requireCoupling(vehicle.names); });

  std::vector<HealthContent::Recording> recordings;
  for (const std::string& name : fileNames(bags.paths)) recordings.push_back({name, begins[recordings.size()]});
  nlohmann::json whole =
      toJson(describe(*recorded.monitor().coupling(), vehicle.names, options.forceNames()), vehicle.names);
  whole["silent"] = gaps.toJson();
  std::vector<HealthContent> contents;
  for (const std::size_t i : vehicle.asked) {
    const SuspensionMonitor& strut = *recorded.monitor().strut(i);
    const std::string reference =
        describeReference(strut.baseline(), watched[i].healthy ? watched[i].healthy->file : "");
    whole["struts"][vehicle.names[i]] = toJson(recorded.log(i), strut);
    contents.push_back(
        {recorded.log(i), files.course(placeInFiles(i)), strut, recordings, reference, vehicle.names[i]});
    std::printf("\n%s, ", vehicle.names[i].c_str());
    printHealth(recorded.log(i), strut, reference);
  }
  files.commit(whole, contents, originOf(values, topicsOf(streams)));
}

}  // namespace suspension_health_monitor
