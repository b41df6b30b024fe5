#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../ros/live_model.h"
#include "../ros/message_pipeline.h"
#include "healthy_strut.h"
#include "imu_bags.h"
#include "suspension_health_monitor/internal/monitor/health_log.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What a strut is watched with, as live.
struct WatchedStrut {
  LiveModel model;
  std::optional<HealthyStrut> healthy;
};

/// Reads the files of all struts; that of --baseline takes the place of baseline_file.
/// @throws std::invalid_argument  naming strut, file and what is wrong.
std::vector<WatchedStrut> readWatched(const boost::program_options::variables_map& values, const AskedVehicle& vehicle,
                                      VehicleOptions& options);

/// @return so many struts with the plain model, to be judged by their settings.
std::vector<WatchedStrut> plainStruts(std::size_t count);

/// The monitor of VehicleNodelet over recorded drives, with a log for every strut.
class WatchedVehicle {
 public:
  using Row = std::function<void(std::size_t strut, const HealthMoment&, const Baseline&)>;
  using Report = std::function<void(std::size_t strut, const MonitorReport&)>;

  /// @param row  called as HealthLog calls its sink, with what the strut is judged by then, if it is given.
  /// @param report  called with every report, if it is given.
  WatchedVehicle(const VehicleOptions& options, const VehicleStreams& streams, const std::vector<WatchedStrut>& watched,
                 const tf2::BufferCore* transforms, const Row& row, const Report& report = {});
  WatchedVehicle(const WatchedVehicle&) = delete;  // its sinks refer to it
  WatchedVehicle& operator=(const WatchedVehicle&) = delete;

  /// Reads one bag after the other.
  /// @return the time elapsed when each begins.
  std::vector<Stamp> read(const ImuBags& bags);

  /// Tells people what the bags hold.
  void printInput() const;

  /// @throws TooLittleError  if the drives do not tell how the struts move one another.
  void requireCoupling(const std::vector<std::string>& names) const;

  /// @param forces  names of the known forces.
  /// @return what is known at the end.
  /// @throws TooLittleError  as requireCoupling().
  VehicleIdentification identified(const std::vector<std::string>& names, const std::vector<std::string>& forces);

  /// @return what was kept out of the readings of all sensors.
  RejectCounts rejected() const;

  const VehicleMonitor& monitor() const { return *pipeline_.monitor(); }
  std::string alignment() const { return pipeline_.grid()->streams().describeAlignment(); }
  const HealthLog& log(std::size_t strut) const { return logs_[strut]; }

 private:
  Baseline baselineOf(std::size_t strut) const;

  std::vector<std::string> topics_;
  std::vector<HealthLog> logs_;
  MessagePipeline pipeline_;
};

}  // namespace suspension_health_monitor
