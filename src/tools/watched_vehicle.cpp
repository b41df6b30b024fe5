#include "watched_vehicle.h"

#include <cstdio>
#include <utility>

#include "../ros/conversions.h"
#include "bag_options.h"
#include "command.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_identification.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {

std::vector<WatchedStrut> readWatched(const boost::program_options::variables_map& values, const AskedVehicle& vehicle,
                                      const VehicleOptions& options) {
  const std::vector<std::optional<HealthyStrut>> healthy = healthyOf(values, vehicle, options);
  std::vector<WatchedStrut> watched;
  for (std::size_t i = 0; i < healthy.size(); ++i)
    prefixed("struts/" + vehicle.names[i] + ": ", [&] {
      watched.push_back({LiveModel(options.struts[i].shell, options.model_of[i]), healthy[i]});
    });
  return watched;
}

std::vector<WatchedStrut> plainStruts(std::size_t count) {
  return std::vector<WatchedStrut>(count, WatchedStrut{LiveModel({}), {}});
}

WatchedVehicle::WatchedVehicle(const boost::program_options::variables_map& values, AskedVehicle& vehicle,
                               const VehicleOptions& options, std::vector<WatchedStrut> watched, const Row& row,
                               const Report& report)
    : options_(options),
      names_(vehicle.names),
      watched_(std::move(watched)),
      bags_(readBags(values, options.common.shell)),
      streams_(streamsOf(bags_, options.common, vehicle.layout)),
      topics_(topicsOf(streams_)),
      gaps_(options.common.shell.input_timeout),
      pipeline_(
          options, streams_, bags_.transforms.get(),
          [this, report](std::size_t strut, const MonitorReport& newest) {
            logs_[strut].addReport(newest);
            if (report) report(strut, newest);
          },
          false) {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const LiveModel& model = watched_[i].model;
    pipeline_.setEffects(model.effects(), model.strutFor(model.effects()), i);
    if (watched_[i].healthy) pipeline_.setBaseline(watched_[i].healthy->baseline, i);
    logs_.emplace_back(fromSeconds(options.common.shell.input_timeout), topics_,
                       [this, i, row](const HealthMoment& moment) {
                         if (row) row(i, moment, baselineOf(i));
                       });
  }
}

void WatchedVehicle::requirePeriod() const {
  if (const auto period = options_.common.monitor.sample_period) requireFittingPeriod(bags_, *period);
}

std::vector<HealthContent::Recording> WatchedVehicle::read() {
  std::vector<HealthContent::Recording> recordings;
  const auto take = [this](std::size_t sensor, const auto& message, Stamp recorded) {
    for (HealthLog& log : logs_) log.addReading(sensor, toStamp(message.header.stamp), recorded);
    pipeline_.push(sensor, message);
    if (pipeline_.monitor() != nullptr) pipeline_.monitor()->fitBodyIfDue();
    return true;
  };
  for (const std::string& name : fileNames(bags_.paths)) {
    ImuBags bag = bags_;
    bag.paths = {bags_.paths[recordings.size()]};
    bag.gaps = &gaps_;
    recordings.push_back({name, logs_.front().elapsed()});
    readTopics(bag, {take, take});
    pipeline_.finish();
    for (HealthLog& log : logs_) log.finishRecording();
  }
  if (pipeline_.monitor() != nullptr) pipeline_.monitor()->fitBody();
  return recordings;
}

void WatchedVehicle::printInput() const {
  if (pipeline_.monitor() != nullptr) {
    std::printf("sample period %.6g s\n", *pipeline_.period());
    printReadings(pipeline_.grid()->numInstants(), logs_.size(), alignment(), pipeline_.grid()->bodyLevel());
    for (std::size_t i = 0; i < topics_.size(); ++i) printRejected(topics_[i], pipeline_.rejected(i));
  }
  for (const std::string& fault : pipeline_.mountFaults(topics_))
    if (!fault.empty()) std::printf("warning: %s\n", fault.c_str());
  gaps_.print();
}

RejectCounts WatchedVehicle::rejected() const {
  RejectCounts all;
  for (std::size_t i = 0; i < topics_.size(); ++i) all += pipeline_.rejected(i);
  return all;
}

void WatchedVehicle::requireCoupling() const {
  gaps_.explain([&] {
    const VehicleMonitor* monitor = pipeline_.monitor();
    if (monitor == nullptr) throw TooLittleError(describeNoStart("on one of " + join(topics_)));
    if (!monitor->isCoupled()) throw TooLittleError("the drives " + whyNotCoupled(monitor->mistake(), names_));
  });
}

VehicleIdentification WatchedVehicle::identified() {
  requireCoupling();
  VehicleIdentification result =
      suspension_health_monitor::identified(*pipeline_.monitor(), names_, options_.forceNames());
  const std::vector<std::string> faults = pipeline_.mountFaults(topics_);
  for (std::size_t i = 0; i < result.struts.size(); ++i)
    for (const std::size_t sensor :
         {streams_.bodyImuOf(i), streams_.options[streams_.channels.struts[i].unsprung].sensor})
      if (!faults[sensor].empty()) result.struts[i].warnings.push_back(faults[sensor]);
  return result;
}

VehicleCoupling WatchedVehicle::coupling() const { return couplingOf(monitor(), names_, options_.forceNames()); }

std::string WatchedVehicle::baselineFile(std::size_t strut) const {
  return watched_[strut].healthy ? watched_[strut].healthy->file : "";
}

Baseline WatchedVehicle::baselineOf(std::size_t strut) const {
  return pipeline_.strut(strut) != nullptr ? pipeline_.baseline(strut) : Baseline{};
}

}  // namespace suspension_health_monitor
