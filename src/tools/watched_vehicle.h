#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../ros/live_model.h"
#include "../ros/message_pipeline.h"
#include "health_page.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/monitor/health_log.h"

namespace suspension_health_monitor {

/// What a strut is watched with, as live.
struct WatchedStrut {
  LiveModel model;
  std::optional<HealthyStrut> healthy;
};

/// Reads the files of all struts; that of --baseline takes the place of baseline_file.
/// @throws std::invalid_argument  naming strut, file and what is wrong.
std::vector<WatchedStrut> readWatched(const boost::program_options::variables_map& values, const AskedVehicle& vehicle,
                                      const VehicleOptions& options);

/// @return so many struts with the plain model, to be judged by their settings.
std::vector<WatchedStrut> plainStruts(std::size_t count);

/// The monitor of VehicleNodelet over recorded drives, with a log for every strut.
class WatchedVehicle {
 public:
  using Row = std::function<void(std::size_t strut, const HealthMoment&, const Baseline&)>;
  using Report = std::function<void(std::size_t strut, const MonitorReport&)>;

  /// @param values  with the bags.
  /// @param vehicle  whose struts with a frame get their position.
  /// @param options  outlive this object.
  /// @param row  called as HealthLog calls its sink, with what the strut is judged by then, if it is given.
  /// @param report  called with every report, if it is given.
  /// @throws InputError, TooLittleError, std::invalid_argument  as streamsOf().
  WatchedVehicle(const boost::program_options::variables_map& values, AskedVehicle& vehicle,
                 const VehicleOptions& options, std::vector<WatchedStrut> watched, const Row& row,
                 const Report& report = {});
  WatchedVehicle(const WatchedVehicle&) = delete;  // its sinks refer to it
  WatchedVehicle& operator=(const WatchedVehicle&) = delete;

  /// @throws std::invalid_argument  as requireFittingPeriod(), if a sample_period is given.
  void requirePeriod() const;

  /// Reads one bag after the other.
  std::vector<HealthContent::Recording> read();

  /// Tells people what the bags hold, and which topics were silent.
  void printInput() const;

  /// @throws TooLittleError  if the drives do not tell how the struts move one another.
  void requireCoupling() const;

  /// @return what is known at the end.
  /// @throws TooLittleError  as requireCoupling().
  VehicleIdentification identified();

  /// @return how the struts move one another, as it is known at the end.
  VehicleCoupling coupling() const;

  /// @return what was kept out of the readings of all sensors.
  RejectCounts rejected() const;

  /// @return the file that a strut's baseline was read from; empty: none was.
  std::string baselineFile(std::size_t strut) const;

  const TopicGaps& gaps() const { return gaps_; }
  const VehicleMonitor& monitor() const { return *pipeline_.monitor(); }
  std::string alignment() const { return pipeline_.grid()->streams().describeAlignment(); }
  const HealthLog& log(std::size_t strut) const { return logs_[strut]; }
  const std::vector<std::string>& topics() const { return topics_; }

 private:
  Baseline baselineOf(std::size_t strut) const;

  const VehicleOptions& options_;
  std::vector<std::string> names_;
  std::vector<WatchedStrut> watched_;
  ImuBags bags_;
  VehicleStreams streams_;
  std::vector<std::string> topics_;
  TopicGaps gaps_;
  std::vector<HealthLog> logs_;
  MessagePipeline pipeline_;
};

}  // namespace suspension_health_monitor
