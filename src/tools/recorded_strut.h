#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <string>
#include <vector>

#include "../ros/imu_mount.h"
#include "../ros/message_pipeline.h"
#include "bag_options.h"
#include "health_page.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/monitor/drive_identification.h"
#include "suspension_health_monitor/internal/monitor/health_log.h"

namespace suspension_health_monitor {

// What the commands of one strut make of bags, before it is printed or written: for the command line and for Python.
// All of it throws InputError, TooLittleError or std::invalid_argument as command.h.

/// `suspension_bag identify`.
class RecordedIdentification {
 public:
  /// @param report  called with the monitor's report after every sample that was taken in.
  RecordedIdentification(const BagOptions& options, DriveIdentification::Sink report);

  /// Reads the bags.
  /// @param gaps  is told of all that is read.
  void read(TopicGaps& gaps);

  DriveIdentification& made() { return made_; }

  /// @return everything that was kept out.
  RejectCounts rejected() const;

 private:
  BagOptions options_;
  DriveIdentification made_;
  StrutSensors sensors_;
};

/// `suspension_bag health`: the monitor of MonitorNodelet over recorded drives, with its log.
class RecordedMonitor {
 public:
  using Row = std::function<void(const HealthMoment&, const Baseline&)>;

  /// @param row  called as HealthLog calls its sink, with what the strut is judged by then.
  /// @param report  called with every report, if it is given.
  RecordedMonitor(const BagOptions& options, const Row& row,
                  const std::function<void(const MonitorReport&)>& report = {});

  /// Reads one bag after the other.
  std::vector<HealthContent::Recording> read(TopicGaps& gaps);

  const HealthLog& log() const { return log_; }
  const SuspensionMonitor& monitor() const { return *pipeline_.strut(); }
  const StreamGrid& grid() const { return pipeline_.grid()->streams(); }
  RejectCounts rejected() const { return pipeline_.rejected(); }

  /// @return the file that the baseline was read from; empty: none was.
  std::string baselineFile() const { return healthy_ ? healthy_->file : ""; }

  /// @throws TooLittleError  if the bags hold too little for one estimate.
  void requireEnough() const;

 private:
  BagOptions options_;
  std::optional<HealthyStrut> healthy_;  // known beforehand
  HealthLog log_;
  MessagePipeline pipeline_;
};

/// @return the options as a live monitor would have them, with the healthy strut of --baseline.
BagOptions readMonitorOptions(const boost::program_options::variables_map& values);

/// `suspension_bag compare`.
Comparison compareBags(const BagOptions& options, const ModelOptions& models, TopicGaps& gaps,
                       const std::function<void(double)>& progress);

/// `suspension_bag diagnose`.
struct RecordedDiagnosis {
  std::vector<Drive> drives;
  DiagnoseOptions options;
  Diagnosis found;
  std::string change;  ///< how the strut is against the healthy one, as identify says it; empty: none is known
};

RecordedDiagnosis diagnoseBags(const BagOptions& options, const ModelOptions& models, int threads, TopicGaps& gaps,
                               const std::function<void(double)>& progress);

}  // namespace suspension_health_monitor
