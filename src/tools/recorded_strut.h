#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../ros/imu_mount.h"
#include "../ros/message_pipeline.h"
#include "bag_options.h"
#include "health_page.h"
#include "strut_files.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/monitor/health_log.h"

namespace suspension_health_monitor {

// What the commands of one strut make of bags, before it is printed or written: for the command line and for Python.
// All of it throws InputError, TooLittleError or std::invalid_argument as command.h.

/// `suspension_bag health` and `identify`: the monitor of MonitorNodelet over recorded drives, with its log.
class RecordedMonitor {
 public:
  using Row = std::function<void(const HealthMoment&, const Baseline&)>;
  using Report = std::function<void(const MonitorReport&)>;

  /// @param healthy  what the strut is judged by, if it is known beforehand.
  /// @param row  called as HealthLog calls its sink, with what the strut is judged by then, if it is given.
  /// @param report  called with every report, if it is given.
  RecordedMonitor(const BagOptions& options, const std::optional<HealthyStrut>& healthy, const Row& row,
                  const Report& report = {});

  /// Reads one bag after the other.
  /// @throws TooLittleError  if the bags hold too little for one estimate.
  std::vector<HealthContent::Recording> read();

  /// Tells people which topics were silent and what the bags hold: period and horizon, samples, what was kept out, how
  /// readings were aligned.
  void printInput() const;

  const TopicGaps& gaps() const { return gaps_; }
  const HealthLog& log() const { return log_; }
  VehiclePipeline& strut() { return pipeline_; }
  const SuspensionMonitor& monitor() const { return *pipeline_.strut(); }
  const StreamGrid& grid() const { return pipeline_.grid()->streams(); }
  RejectCounts rejected() const { return pipeline_.rejected(); }

  /// @return how gravity in the IMUs contradicts the settings, in sentences.
  std::vector<std::string> mountFaults() const;

  /// @return the file that the baseline was read from; empty: none was.
  std::string baselineFile() const { return healthy_ ? healthy_->file : ""; }

 private:
  void requireEnough() const;

  BagOptions options_;
  std::optional<HealthyStrut> healthy_;
  TopicGaps gaps_;
  HealthLog log_;
  MessagePipeline pipeline_;
};

/// What came of reading samples.
struct ReadSamples {
  StreamGrid grid;  ///< after the last reading
  RejectCounts rejected;
};

/// Reads bags as samples of the strut: acceleration along the axis, both sensors aligned.
/// @param take  called with every sample; returns false to stop.
/// @param take_body  if given, called with what the body's IMU measures across the strut, message by message, in the
/// order of their stamps.
/// @param take_back  if given, called where the grid begins to resample: the newest AlignmentJudge::kOutcomes samples
/// were found to be badly paired.
ReadSamples readSamples(const ImuBags& bags, const PipelineOptions& options,
                        const std::function<bool(const CornerSample&)>& take,
                        const std::function<void(const BodyMotion&)>& take_body = {},
                        const std::function<void()>& take_back = {});

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
