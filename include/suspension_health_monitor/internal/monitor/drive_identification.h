#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/identification/instrumental_variables.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/monitor/strut_pipeline.h"

namespace suspension_health_monitor {

/// @return what is wrong with the stamps for the sample period that was given, in words; nothing: they fit.
std::optional<std::string> periodWarning(const SuspensionMonitor& monitor);

/// @return the strut as an estimator of the live monitor knows it at the end of a drive.
IdentifiedStrut atTheEnd(const StrutEstimate& estimate);

/// Identifies the strut of a recorded drive reading by reading: what identify() does with arrays and `suspension_bag
/// identify` with bags of any length. LS, LA and the tyre are those of a StrutPipeline, as live; instrumental variables
/// run over the whole drive beside them. Cost per reading: O(1) amortised; memory does not grow with the drive.
class DriveIdentification {
 public:
  using Sink = std::function<void(const MonitorReport&)>;

  /// @param settings  with sample_period given.
  /// @param sink  called with the monitor's report after every sample that was taken in.
  /// @throws std::invalid_argument  as MonitorOptions::validate().
  explicit DriveIdentification(const MonitorSettings& settings, Sink sink = {});
  DriveIdentification(const DriveIdentification&) = delete;  // its strut's sinks refer to it
  DriveIdentification& operator=(const DriveIdentification&) = delete;

  /// Has these effects in the model of LS and LA; the instrumental variables know the plain strut only, and rest.
  /// @throws std::invalid_argument  as SuspensionMonitor::setEffects().
  void setEffects(const std::vector<ActiveEffect>& effects);

  /// As StrutPipeline::push().
  void push(Side side, Stamp stamp, double acceleration) { strut_.push(side, stamp, acceleration); }

  /// @return what is known so far.
  IdentifyResult result() const;

  /// @return readings that were kept out so far.
  RejectCounts rejected() const { return strut_.rejected(); }

  const SuspensionMonitor& monitor() const { return *strut_.monitor(); }
  const UniformGrid& grid() const { return *strut_.grid(); }
  const TyreTracker* tyre() const { return strut_.tyre(); }

 private:
  /// What the estimate over the whole drive is made of, and doubted by.
  struct WholeDrive {
    explicit WholeDrive(const MonitorSettings& settings, int rows_late);
    InstrumentalVariables strut;
    RunningMean wrong_variance;  // as InstrumentalVariables::RowErrors, by the live estimation
  };

  void take(const CornerSample& sample);
  IdentifiedStrut overTheDrive() const;

  StrutPipeline strut_;
  InputStatus seen_;                       // of the monitor, before the newest sample
  std::optional<WholeDrive> whole_drive_;  // none: there are effects in the model
};

}  // namespace suspension_health_monitor
