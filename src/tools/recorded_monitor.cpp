#include "recorded_monitor.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <utility>

#include "../ros/conversions.h"
#include "../ros/live_model.h"
#include "command.h"
#include "recorded_drives.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {

RecordedMonitor::RecordedMonitor(const BagOptions& options, HealthyStruts healthy, bool keeps_logs,
                                 const Report& report, const Row& row)
    : options_(options),
      healthy_(std::move(healthy)),
      streams_(options.vehicle.layout),
      topics_(namesOf(options.bags.topics)),
      gaps_(options.settings.common.shell.input_timeout),
      pipeline_(
          options.settings, streams_, options.bags.transforms.get(),
          [this, report](std::size_t strut, const MonitorReport& newest) {
            if (!logs_.empty()) logs_[strut].addReport(newest);
            if (report) report(strut, newest);
          },
          false) {
  for (std::size_t i = 0; i < healthy_.size(); ++i) {
    const LiveModel model = prefixed(options.settings.prefix(i), [&] {
      return LiveModel(options.settings.struts[i].shell, options.settings.model_of[i]);
    });
    pipeline_.setEffects(model.effects(), model.strutFor(model.effects()), i);
    if (healthy_[i]) pipeline_.setBaseline(healthy_[i]->baseline, i);
    if (keeps_logs)
      logs_.emplace_back(fromSeconds(options.settings.common.shell.input_timeout), options.bags.neededTopics(),
                         [this, i, row](const HealthMoment& moment) {
                           if (row) row(i, moment, pipeline_.baseline(i));
                         });
  }
}

std::vector<RecordedMonitor::Recording> RecordedMonitor::read() {
  std::vector<Recording> recordings;
  const auto take = [this](std::size_t sensor, const auto& message, Stamp recorded) {
    if (options_.bags.topics[sensor].is_needed)
      for (HealthLog& log : logs_) log.addReading(sensor, toStamp(message.header.stamp), recorded);
    pipeline_.push(sensor, message);
    if (pipeline_.monitor() != nullptr) pipeline_.monitor()->fitBodyIfDue();
    return true;
  };
  const std::vector<std::string>& thermometers = options_.bags.temperature_topics;
  const auto take_temperature = [&](std::size_t topic, const sensor_msgs::Temperature& message, Stamp) {
    for (std::size_t i = 0; i < thermometers.size(); ++i)
      if (thermometers[i] == thermometers[topic]) pipeline_.push(i, message);
    return true;
  };
  for (const std::string& path : options_.bags.paths) {
    recordings.push_back({fileNames({path}).front(), logs_.empty() ? Stamp::zero() : logs_.front().elapsed()});
    readTopics(options_.bags.of(path, gaps_), {take, take, take_temperature});
    pipeline_.finish();
    for (HealthLog& log : logs_) log.finishRecording();
  }
  if (pipeline_.monitor() != nullptr) pipeline_.monitor()->fitBody();
  gaps_.explain([&] {
    const std::string why = whyTooLittle();
    if (!why.empty()) throw TooLittleError(join({why, join(mountFaults(), "; ")}, "; "));
  });
  return recordings;
}

std::string RecordedMonitor::whyTooLittle() const {
  const VehicleMonitor* monitor = pipeline_.monitor();
  const RejectCounts rejected = pipeline_.rejected();
  if (monitor == nullptr) return describeNoStart("on one of " + join(topics_)) + describeRejected(rejected);
  const AskedVehicle& vehicle = options_.vehicle;
  if (!monitor->isCoupled())
    return "the drives " + whyNotCoupled(monitor->mistake(), vehicle.names) + describeRejected(rejected);
  const auto hasRow = [&](std::size_t i) { return strut(i).input().rows > 0; };
  if (std::any_of(vehicle.asked.begin(), vehicle.asked.end(), hasRow)) return "";
  return describeNoRow(strut(vehicle.asked.front()), grid(), rejected);
}

void RecordedMonitor::printInput() const {
  gaps_.print();
  printPeriod(options_, *pipeline_.period());
  std::vector<RejectCounts> rejected;
  for (std::size_t i = 0; i < topics_.size(); ++i) rejected.push_back(pipeline_.rejected(i));
  printReadings(*pipeline_.grid(), options_.bags, rejected);
  for (const std::size_t i : options_.vehicle.asked) {
    const InputStatus& input = strut(i).input();
    const int horizon = strut(i).horizonSamples();
    std::printf("%ssamples %" PRIu64 ", rows %" PRIu64 ", gaps %" PRIu64 ", clock jumps %" PRIu64
                ", horizon %d samples = %.4g s%s%s\n",
                options_.vehicle.prefix(i, ": ").c_str(), input.samples, input.rows, input.gaps, input.restarts,
                horizon, horizon * strut(i).period(), options_.horizon_measured ? " (proposed from the data)" : "",
                describeRejected(strut(i).rejected()).c_str());
    const std::string& thermometer = options_.bags.temperature_topics[i];
    if (!thermometer.empty() && !strut(i).report().estimate.temperature)
      std::printf("warning: no temperature on %s\n", thermometer.c_str());
  }
  for (const std::string& fault : mountFaults())
    if (!fault.empty()) std::printf("warning: %s\n", fault.c_str());
}

VehicleIdentification RecordedMonitor::identified() {
  VehicleIdentification result = suspension_health_monitor::identified(*pipeline_.monitor(), options_.vehicle.names,
                                                                       options_.settings.forceNames());
  for (std::size_t i = 0; i < result.struts.size(); ++i) {
    result.struts[i].rejected = pipeline_.rejected().byName();
    for (const std::string& fault : mountFaults(i)) result.struts[i].warnings.push_back(fault);
  }
  return result;
}

std::vector<std::string> RecordedMonitor::mountFaults(std::size_t strut) const {
  const std::vector<std::string> all = mountFaults();
  std::vector<std::string> faults{all[streams_.bodyImuOf(strut)], all[streams_.wheelImuOf(strut)]};
  faults.erase(std::remove(faults.begin(), faults.end(), ""), faults.end());
  return faults;
}

}  // namespace suspension_health_monitor
