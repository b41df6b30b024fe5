#include "recorded_strut.h"

#include <filesystem>

#include "../ros/conversions.h"
#include "../ros/live_model.h"
#include "command.h"
#include "healthy_strut.h"
#include "identify_tables.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {

RecordedIdentification::RecordedIdentification(const BagOptions& options, DriveIdentification::Sink report)
    : options_(options),
      made_(options.pipeline.monitor, std::move(report)),
      sensors_(options.pipeline.shell, options.bags.transforms.get()) {
  made_.setEffects(LiveModel(options.pipeline.shell).effects());
}

void RecordedIdentification::read(TopicGaps& gaps) {
  ImuBags bags = options_.bags;
  bags.gaps = &gaps;
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    if (const auto acceleration = sensors_.read(side, imu)) made_.push(side, toStamp(imu.header.stamp), *acceleration);
    return true;
  });
}

RejectCounts RecordedIdentification::rejected() const {
  RejectCounts all = sensors_.rejected();
  all += made_.rejected();
  return all;
}

RecordedMonitor::RecordedMonitor(const BagOptions& options, const Row& row,
                                 const std::function<void(const MonitorReport&)>& report)
    : options_(options),
      healthy_(beforehand(options.healthy, options.pipeline)),
      log_(fromSeconds(options.pipeline.shell.input_timeout), {options.bags.topics[0], options.bags.topics[1]},
           [this, row](const HealthMoment& moment) { row(moment, pipeline_.baseline()); }),
      pipeline_(VehicleOptions::ofOneStrut(options.pipeline),
                VehicleStreams(VehicleLayout::ofOneStrut(options.pipeline.monitor.tyre)), options.bags.transforms.get(),
                [this, report](std::size_t, const MonitorReport& newest) {
                  log_.addReport(newest);
                  if (report) report(newest);
                }) {
  pipeline_.setEffects(LiveModel(options.pipeline.shell).effects());
  if (healthy_) pipeline_.setBaseline(healthy_->baseline);
}

std::vector<HealthContent::Recording> RecordedMonitor::read(TopicGaps& gaps) {
  std::vector<HealthContent::Recording> recordings;
  for (const std::string& path : options_.bags.paths) {
    recordings.push_back({std::filesystem::path(path).filename().string(), log_.elapsed()});
    ImuBags bag = options_.bags;
    bag.paths = {path};
    bag.gaps = &gaps;
    readImuMessages(bag, [&](Side side, const sensor_msgs::Imu& imu, Stamp recorded) {
      if (side != Side::kRoad) log_.addReading(indexOf(side), toStamp(imu.header.stamp), recorded);
      if (side != Side::kRoad || options_.pipeline.monitor.tyre) pipeline_.push(indexOf(side), imu);
      return true;
    });
    log_.finishRecording();
  }
  return recordings;
}

void RecordedMonitor::requireEnough() const {
  if (pipeline_.strut() == nullptr)
    throw TooLittleError(describeNoStart("on one of the topics") + describeRejected(rejected()));
  requireRows(monitor(), grid(), rejected());
}

BagOptions readMonitorOptions(const boost::program_options::variables_map& values) {
  BagOptions options = readLiveOptions(values);
  takeHealthy(values, options);
  return options;
}

Comparison compareBags(const BagOptions& options, const ModelOptions& models, TopicGaps& gaps,
                       const std::function<void(double)>& progress) {
  CompareOptions comparing;
  takeSettings(options, models, comparing);
  comparing.fit = !models.model;
  comparing.progress = progress;
  Comparison comparison = compare(readDrives(options, gaps), comparing);
  gaps.explain([&] { requireEnough(comparison.shortcoming, comparison.reason); });
  return comparison;
}

RecordedDiagnosis diagnoseBags(const BagOptions& options, const ModelOptions& models, int threads, TopicGaps& gaps,
                               const std::function<void(double)>& progress) {
  RecordedDiagnosis recorded;
  takeSettings(options, models, recorded.options);
  recorded.options.candidates = models.library;
  recorded.options.threads = threads;
  recorded.options.progress = progress;
  recorded.drives = readDrives(options, gaps);
  recorded.found = diagnose(recorded.drives, recorded.options);
  gaps.explain([&] { requireEnough(recorded.found.shortcoming, recorded.found.reason); });
  recorded.change =
      describeChange(recorded.drives, recorded.options, knownHealthy({}, options.pipeline), options.pipeline.monitor);
  return recorded;
}

}  // namespace suspension_health_monitor
