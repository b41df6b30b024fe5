#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_pipeline.h"

namespace suspension_health_monitor {

/// @return what is wrong with the stamps for the sample period that was given, in words; nothing: they fit.
std::optional<std::string> periodWarning(const SuspensionMonitor& monitor);

/// @return what an estimator of the live monitor knows of the strut, for results.
IdentifiedStrut toIdentified(const StrutEstimate& estimate);

/// @param over_the_drive  the block estimate over all readings.  @param rejected  readings that were kept out.
/// @return what is known of a strut at the end of a recorded drive.
IdentifyResult identified(const SuspensionMonitor& monitor, const StrutEstimate& over_the_drive,
                          const RejectCounts& rejected);

/// Identifies the strut of a recorded drive reading by reading: what identify() does with arrays and `suspension_bag
/// identify` with bags of any length. LS, LA and the tyre are those of a VehiclePipeline, as live; its blocks
/// give the estimate over the whole drive. Cost per reading: O(1) amortised; memory does not grow with the drive.
class DriveIdentification {
 public:
  using Sink = std::function<void(const MonitorReport&)>;

  /// @param settings  with sample_period given.
  /// @param sink  called with the monitor's report after every sample that was taken in.
  /// @throws std::invalid_argument  as MonitorOptions::validate().
  explicit DriveIdentification(const MonitorSettings& settings, Sink sink = {})
      : strut_(settings, std::move(sink)) {}

  /// @throws std::invalid_argument  as SuspensionMonitor::setEffects().
  void setEffects(const std::vector<ActiveEffect>& effects) { strut_.setEffects(effects); }

  /// As VehiclePipeline::push().
  void push(Side side, Stamp stamp, double acceleration) { strut_.push(side, stamp, acceleration); }

  /// @return what is known so far.
  IdentifyResult result() { return identified(monitor(), strut_.overTheDrive(), rejected()); }

  /// @return readings that were kept out so far.
  RejectCounts rejected() const { return strut_.rejected(); }

  const SuspensionMonitor& monitor() const { return *strut_.strut(); }
  const VehicleGrid& grid() const { return *strut_.grid(); }
  const TyreTracker* tyre() const { return strut_.tyre(); }

 private:
  VehiclePipeline strut_;
};

}  // namespace suspension_health_monitor
