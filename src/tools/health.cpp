#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../ros/conversions.h"
#include "../ros/imu_pipeline.h"
#include "../ros/live_baseline.h"
#include "../ros/live_model.h"
#include "bag_options.h"
#include "bag_samples.h"
#include "command.h"
#include "errors.h"
#include "health_page.h"
#include "health_results.h"
#include "identify_tables.h"
#include "long_work.h"
#include "vehicle_commands.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

/// The options as a live monitor would have them, with the file of --baseline for baseline_file.
BagOptions readOptions(const po::variables_map& values) {
  BagOptions options = readLiveOptions(values);
  takeBaselineFile(values, options.pipeline.shell);
  return options;
}

/// The monitor of MonitorNodelet over recorded drives, with its log.
class RecordedMonitor {
 public:
  /// @param row  called as HealthLog calls its sink, with what the strut is judged by then.
  RecordedMonitor(const BagOptions& options, const std::function<void(const HealthMoment&, const Baseline&)>& row)
      : baseline_(options.pipeline),
        log_(fromSeconds(options.pipeline.shell.input_timeout), {options.bags.topics[0], options.bags.topics[1]},
             [this, row](const HealthMoment& moment) { row(moment, pipeline_.strut().baseline()); }),
        pipeline_(
            options.pipeline, [this](const MonitorReport& report) { log_.addReport(report); },
            options.bags.transforms.get()) {
    pipeline_.strut().setEffects(LiveModel(options.pipeline.shell).effects());
    if (baseline_.known()) pipeline_.strut().setBaseline(*baseline_.known());
  }

  /// Reads one bag after the other.
  /// @throws InputError, TooLittleError  as readImuMessages().
  std::vector<HealthContent::Recording> read(const ImuBags& bags) {
    std::vector<HealthContent::Recording> recordings;
    for (const std::string& path : bags.paths) {
      recordings.push_back({std::filesystem::path(path).filename().string(), log_.elapsed()});
      ImuBags bag = bags;
      bag.paths = {path};
      readImuMessages(bag, [&](Side side, const sensor_msgs::Imu& imu, Stamp recorded) {
        if (side != Side::kRoad) log_.addReading(indexOf(side), toStamp(imu.header.stamp), recorded);
        pipeline_.push(side, imu);
        return true;
      });
      log_.finishRecording();
    }
    return recordings;
  }

  const HealthLog& log() const { return log_; }
  const SuspensionMonitor& monitor() const { return *pipeline_.monitor(); }
  const UniformGrid& grid() const { return *pipeline_.strut().grid(); }
  RejectCounts rejected() const { return pipeline_.rejected(); }
  bool hasBaselineOfFile() const { return baseline_.known().has_value(); }

  /// @throws TooLittleError  if the bags hold too little for one estimate.
  void requireEnough() const {
    if (pipeline_.monitor() == nullptr)
      throw TooLittleError(
          "the sample period cannot be measured: too few readings with increasing stamps on one of the topics (" +
          std::to_string(EarlyReadings<double>::kSpacings + 1) + " of each are enough)" + describeRejected(rejected()));
    requireRows(monitor(), grid(), rejected());
  }

 private:
  LiveBaseline baseline_;
  HealthLog log_;
  ImuPipeline pipeline_;
};

}  // namespace

void health(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addVehicleOptions(description);
  auto add = description.add_options();
  add(kBaseline, po::value<std::string>(),
      "YAML file with the healthy strut, as the monitor writes it; of a vehicle struts: {NAME: ...}");
  add("csv", po::value<std::string>(), "write a line per second and change of level, full precision");
  add(kReport, po::value<std::string>(), "write DIR/report.html: the levels over time as a page with figures");
  const auto values = parse(arguments, "health BAG... [OPTION]...", description, "bag");
  if (!values) return;
  const std::vector<std::string> outputs{"csv", "json", kReport};
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kBaseline}, outputs);
  if (isOfVehicle(*values)) {
    watchStruts(*values);
    return printWritten(*values, outputs);
  }
  const BagOptions options = readOptions(*values);

  const Interruption interruption;
  HealthFiles files(*values, {});
  RecordedMonitor recorded(options,
                           [&](const HealthMoment& moment, const Baseline& healthy) { files.add(0, moment, healthy); });
  TopicGaps gaps(options.pipeline.shell.input_timeout);
  ImuBags bags = options.bags;
  bags.gaps = &gaps;
  const std::vector<HealthContent::Recording> recordings = recorded.read(bags);
  gaps.explain([&] { recorded.requireEnough(); });

  const SuspensionMonitor& monitor = recorded.monitor();
  const std::string reference =
      describeReference(monitor.baseline(), recorded.hasBaselineOfFile() ? options.pipeline.shell.baseline_file : "");
  nlohmann::json whole = toJson(recorded.log(), monitor);
  whole["silent"] = gaps.toJson();
  files.commit(whole, {{recorded.log(), files.course(0), monitor, recordings, reference, ""}},
               originOf(*values, options.bags.topics));
  gaps.print();
  printInput(monitor, recorded.grid(), options, recorded.rejected());
  printHealth(recorded.log(), monitor, reference);
  printWritten(*values, outputs);
}

}  // namespace suspension_health_monitor
