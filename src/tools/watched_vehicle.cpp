#include "watched_vehicle.h"

#include <cstdio>

#include "../ros/conversions.h"
#include "command.h"
#include "recorded_vehicle.h"
#include "suspension_health_monitor/internal/prefixed.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_identification.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {

std::vector<WatchedStrut> readWatched(const boost::program_options::variables_map& values, const AskedVehicle& vehicle,
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

std::vector<WatchedStrut> plainStruts(std::size_t count) {
  return std::vector<WatchedStrut>(count, WatchedStrut{LiveModel({}), {}});
}

WatchedVehicle::WatchedVehicle(const VehicleOptions& options, const VehicleStreams& streams,
                               const std::vector<WatchedStrut>& watched, const tf2::BufferCore* transforms,
                               const Row& row, const Report& report)
    : topics_(topicsOf(streams)),
      pipeline_(options, streams, transforms, [this, report](std::size_t strut, const MonitorReport& newest) {
        logs_[strut].addReport(newest);
        if (report) report(strut, newest);
      }) {
  for (std::size_t i = 0; i < watched.size(); ++i) {
    const LiveModel& model = watched[i].model;
    pipeline_.setEffects(model.effects(), model.strutFor(model.effects()), i);
    if (watched[i].healthy) pipeline_.setBaseline(watched[i].healthy->baseline, i);
    logs_.emplace_back(fromSeconds(options.common.shell.input_timeout), topics_,
                       [this, i, row](const HealthMoment& moment) {
                         if (row) row(i, moment, baselineOf(i));
                       });
  }
}

std::vector<Stamp> WatchedVehicle::read(const ImuBags& bags) {
  std::vector<Stamp> begins;
  const auto take = [this](std::size_t sensor, const auto& message, Stamp recorded) {
    for (HealthLog& log : logs_) log.addReading(sensor, toStamp(message.header.stamp), recorded);
    pipeline_.push(sensor, message);
    if (pipeline_.monitor() != nullptr) pipeline_.monitor()->fitBodyIfDue();
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

void WatchedVehicle::printInput() const {
  if (pipeline_.monitor() == nullptr) return;
  std::printf("sample period %.6g s\n%llu samples of %zu struts, readings %s\n", *pipeline_.period(),
              static_cast<unsigned long long>(pipeline_.grid()->numInstants()), logs_.size(),
              pipeline_.grid()->streams().describeAlignment().c_str());
  const std::string leans = describe(pipeline_.grid()->bodyLevel());
  if (!leans.empty()) std::printf("%s\n", leans.c_str());
  for (std::size_t i = 0; i < topics_.size(); ++i) printRejected(topics_[i], pipeline_.rejected(i));
}

RejectCounts WatchedVehicle::rejected() const {
  RejectCounts all;
  for (std::size_t i = 0; i < topics_.size(); ++i) all += pipeline_.rejected(i);
  return all;
}

void WatchedVehicle::requireCoupling(const std::vector<std::string>& names) const {
  const VehicleMonitor* monitor = pipeline_.monitor();
  if (monitor == nullptr) throw TooLittleError(describeNoStart("on one of " + join(topics_)));
  if (!monitor->isCoupled()) throw TooLittleError("the drives " + whyNotCoupled(monitor->mostAlike(), names));
}

VehicleIdentification WatchedVehicle::identified(const std::vector<std::string>& names,
                                                 const std::vector<std::string>& forces) {
  requireCoupling(names);
  return suspension_health_monitor::identified(*pipeline_.monitor(), names, forces);
}

Baseline WatchedVehicle::baselineOf(std::size_t strut) const {
  return pipeline_.strut(strut) != nullptr ? pipeline_.baseline(strut) : Baseline{};
}

}  // namespace suspension_health_monitor
