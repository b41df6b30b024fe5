#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../ros/message_pipeline.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/wording/health_log.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {

/// The monitor of MonitorNodelet or VehicleNodelet over recorded drives, with a log for every strut: for `identify` and
/// `health`, on the command line and in Python.
class RecordedMonitor {
 public:
  using Report = std::function<void(std::size_t strut, const MonitorReport&)>;
  using Row = std::function<void(std::size_t strut, const HealthMoment&, const Baseline&)>;

  /// A bag, and the time elapsed when it begins.
  struct Recording {
    std::string name;
    Stamp from;
  };

  /// Reads the models that the settings name.
  /// @param options  outlive this object.
  /// @param healthy  by strut what it is judged by, if it is known beforehand.
  /// @param keeps_logs  whether there is a log() of every strut.
  /// @param report  called with every report, if it is given.
  /// @param row  called as HealthLog calls its sink, with what the strut is judged by then, if it is given.
  /// @throws std::invalid_argument  as LiveModel, naming the strut.
  RecordedMonitor(const BagOptions& options, HealthyStruts healthy, bool keeps_logs, const Report& report = {},
                  const Row& row = {});

  /// Reads one bag after the other.
  /// @throws TooLittleError  if the bags hold too little for one row of a strut that is asked for.
  std::vector<Recording> read();

  /// Tells people what the bags hold: period and horizons, samples, what was kept out, how readings were aligned, which
  /// topics were silent, how gravity contradicts the settings.
  void printInput() const;

  /// @return what is known at the end.
  VehicleIdentification identified();

  /// @return the estimate over all readings, with the model's error beside the standard deviations.
  StrutEstimate overTheDrive(std::size_t strut) { return pipeline_.monitor()->overTheDrive(strut); }

  const AskedVehicle& vehicle() const { return options_.vehicle; }
  const VehicleMonitor& monitor() const { return *pipeline_.monitor(); }
  const MessagePipeline& pipeline() const { return pipeline_; }
  const SuspensionMonitor& strut(std::size_t i) const { return *pipeline_.strut(i); }
  const StreamGrid& grid() const { return pipeline_.grid()->streams(); }
  const TopicGaps& gaps() const { return gaps_; }
  const HealthLog& log(std::size_t strut) const { return logs_[strut]; }

  /// @return how gravity in the IMUs of a strut contradicts the settings, in sentences.
  std::vector<std::string> mountFaults(std::size_t strut) const;

  /// @return the file that a strut's baseline was read from; empty: none was.
  std::string baselineFile(std::size_t strut) const { return healthy_[strut] ? healthy_[strut]->file : ""; }

  /// @return what a strut was judged by at the end, in words.
  std::string reference(std::size_t place) const {
    return describeReference(strut(place).baseline(), baselineFile(place));
  }

 private:
  std::vector<std::string> mountFaults() const { return pipeline_.sensors().mountFaults(topics_); }
  std::string whyTooLittle() const;

  const BagOptions& options_;
  HealthyStruts healthy_;
  VehicleStreams streams_;
  std::vector<std::string> topics_;
  TopicGaps gaps_;
  std::vector<HealthLog> logs_;
  MessagePipeline pipeline_;
};

}  // namespace suspension_health_monitor
