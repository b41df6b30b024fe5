#include "recorded_strut.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "../ros/conversions.h"
#include "../ros/live_model.h"
#include "command.h"
#include "recorded_vehicle.h"
#include "suspension_health_monitor/internal/signal/alignment_judge.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

/// Reads bags as drives, one each: both accelerations and what else the body's IMU measures.
std::vector<Drive> readDrives(const BagOptions& options, TopicGaps& gaps) {
  std::vector<Drive> drives;
  for (const std::string& path : options.bags.paths) {
    ImuBags bag = options.bags;
    bag.paths = {path};
    bag.gaps = &gaps;
    Drive& drive = drives.emplace_back();
    const auto take = [&](const CornerSample& sample) {
      drive.samples.push_back(sample);
      return true;
    };
    readSamples(
        bag, options.pipeline, take, [&](const BodyMotion& motion) { drive.body.push_back(motion); },
        [&] { dropNewest(drive.samples, AlignmentJudge::kOutcomes); });
  }
  return drives;
}

}  // namespace

RecordedMonitor::RecordedMonitor(const BagOptions& options, const std::optional<HealthyStrut>& healthy, const Row& row,
                                 const Report& report)
    : options_(options),
      healthy_(healthy),
      gaps_(options.pipeline.shell.input_timeout),
      log_(fromSeconds(options.pipeline.shell.input_timeout), {options.bags.topics[0], options.bags.topics[1]},
           [this, row](const HealthMoment& moment) {
             if (row) row(moment, pipeline_.baseline());
           }),
      pipeline_(
          VehicleOptions::ofOneStrut(options.pipeline),
          VehicleStreams(VehicleLayout::ofOneStrut(options.pipeline.monitor.tyre)), options.bags.transforms.get(),
          [this, report](std::size_t, const MonitorReport& newest) {
            log_.addReport(newest);
            if (report) report(newest);
          },
          false) {
  const LiveModel model(options.pipeline.shell);
  pipeline_.setEffects(model.effects(), model.strutFor(model.effects()));
  if (healthy_) pipeline_.setBaseline(healthy_->baseline);
}

std::vector<HealthContent::Recording> RecordedMonitor::read() {
  std::vector<HealthContent::Recording> recordings;
  for (const std::string& path : options_.bags.paths) {
    recordings.push_back({std::filesystem::path(path).filename().string(), log_.elapsed()});
    ImuBags bag = options_.bags;
    bag.paths = {path};
    bag.gaps = &gaps_;
    const auto take = [&](std::size_t side, const sensor_msgs::Imu& imu, Stamp recorded) {
      const bool is_road = side == indexOf(Side::kRoad);
      if (!is_road) log_.addReading(side, toStamp(imu.header.stamp), recorded);
      if (!is_road || options_.pipeline.monitor.tyre) pipeline_.push(side, imu);
      return true;
    };
    readTopics(bag, {take, {}});
    log_.finishRecording();
  }
  gaps_.explain([&] { requireEnough(); });
  return recordings;
}

void RecordedMonitor::requireEnough() const {
  if (pipeline_.strut() == nullptr)
    throw TooLittleError(describeNoStart("on one of the topics") + describeRejected(rejected()));
  const std::string nothing = describeNoRow(monitor(), grid(), rejected());
  if (nothing.empty()) return;
  std::vector<std::string> all = mountFaults();
  all.insert(all.begin(), nothing);
  throw TooLittleError(join(all, "; "));
}

std::vector<std::string> RecordedMonitor::mountFaults() const {
  std::vector<std::string> faults = pipeline_.mountFaults({"the sprung IMU", "the unsprung IMU"});
  faults.erase(std::remove(faults.begin(), faults.end(), ""), faults.end());
  return faults;
}

void RecordedMonitor::printInput() const {
  gaps_.print();
  const InputStatus& input = monitor().input();
  std::printf("sample period %.6g s%s, horizon %d samples = %.4g s%s\n", monitor().period(),
              options_.period_measured ? " (measured)" : "", monitor().horizonSamples(),
              monitor().horizonSamples() * monitor().period(),
              options_.horizon_measured ? " (proposed from the data)" : "");
  std::printf("samples %" PRIu64 ", rows %" PRIu64 ", gaps %" PRIu64 ", clock jumps %" PRIu64, input.samples,
              input.rows, input.gaps, input.restarts);
  if (grid().resamples()) std::printf(", bridged %" PRIu64, grid().bridged());
  const RejectCounts counts = rejected();
  if (counts.total() == 0) std::printf(", rejected 0");
  for (std::size_t i = 0; i < kRejectReasonNames.size(); ++i)
    if (const std::uint64_t count = counts.count(static_cast<RejectReason>(i)))
      std::printf(", rejected %s %" PRIu64, std::string(kRejectReasonNames[i]).c_str(), count);
  std::printf("\nreadings %s\n", grid().describeAlignment().c_str());
  for (const std::string& fault : mountFaults()) std::printf("warning: %s\n", fault.c_str());
  std::printf("\n");
}

ReadSamples readSamples(const ImuBags& bags, const PipelineOptions& options,
                        const std::function<bool(const CornerSample&)>& take,
                        const std::function<void(const BodyMotion&)>& take_body,
                        const std::function<void()>& take_back) {
  const VehicleStreams streams(VehicleLayout::ofOneStrut(false));
  VehicleSensors sensors(streams, options.shell, bags.transforms.get());
  MonitorSettings settings = options.monitor;
  settings.tyre = false;  // a sample has no part of the road
  const double period = *settings.sample_period;
  bool goes_on = true;
  VehicleGrid grid(period, streams, settings.grid(period),
                   [&](const VehicleSample& sample) { goes_on = goes_on && take(sample.ofStrut(0)); });
  Stamp last_body{};
  const auto take_imu = [&](std::size_t place, const sensor_msgs::Imu& imu, Stamp) {
    if (place == indexOf(Side::kRoad)) return true;
    const std::vector<double>& acceleration = sensors.read(place, imu);
    if (acceleration.empty()) return true;
    const Stamp stamp = toStamp(imu.header.stamp);
    if (take_body && place == indexOf(Side::kSprung) && stamp > last_body) {
      last_body = stamp;
      take_body(sensors.mount(place).across(imu));
    }
    if (grid.push(place, stamp, acceleration) && take_back) take_back();
    return goes_on;
  };
  readTopics(bags, {take_imu, {}});
  RejectCounts rejected = grid.streams().rejected();
  for (const Side side : {Side::kSprung, Side::kUnsprung}) rejected += sensors.rejected(indexOf(side));
  return {grid.streams(), rejected};
}

Comparison compareBags(const BagOptions& options, const ModelOptions& models, TopicGaps& gaps,
                       const std::function<void(double)>& progress) {
  CompareOptions comparing = compareOptionsOf(options.pipeline, *options.pipeline.monitor.sample_period, models.model);
  comparing.progress = progress;
  Comparison comparison = compare(readDrives(options, gaps), comparing);
  gaps.explain([&] { requireEnough(comparison.shortcoming, comparison.reason); });
  return comparison;
}

RecordedDiagnosis diagnoseBags(const BagOptions& options, const ModelOptions& models, int threads, TopicGaps& gaps,
                               const std::function<void(double)>& progress) {
  RecordedDiagnosis recorded;
  recorded.options.sample_period = options.pipeline.monitor.sample_period;
  recorded.options.horizon_samples = givenHorizon(options.pipeline, *options.pipeline.monitor.sample_period);
  recorded.options.model = models.model;
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
