#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/identification/instrumental_variables.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"
#include "suspension_health_monitor/internal/signal/uniform_grid.h"

namespace suspension_health_monitor {

/// @return what is wrong with the stamps for the sample period that was given, in words; nothing: they fit.
std::optional<std::string> periodWarning(const SuspensionMonitor& monitor);

/// Identifies the strut of a recorded drive reading by reading: what identify() does with arrays and `suspension_bag
/// identify` with bags of any length. Readings are aligned and checked as live (UniformGrid); LS and LA are those of
/// the monitor, instrumental variables run over the whole drive beside them, and a TyreTracker if there is a road
/// sensor. Cost per reading: O(1) amortised; memory does not grow with the drive.
class DriveIdentification {
 public:
  using Sink = std::function<void(const MonitorReport&)>;

  /// @param options  with sample_period given.
  /// @param sink  called with the monitor's report after every sample that was taken in.
  /// @throws std::invalid_argument  as MonitorOptions::validate().
  DriveIdentification(const MonitorOptions& options, const GridOptions& grid, Sink sink = {});

  /// Has these effects in the model of LS and LA; the instrumental variables know the plain strut only, and rest.
  /// @throws std::invalid_argument  as SuspensionMonitor::setEffects().
  void setEffects(const std::vector<ActiveEffect>& effects);

  /// Takes in one reading of one sensor; each stream comes in the order in which it was measured.
  /// @param acceleration  along the strut, up positive [m/s^2].
  void push(Side side, Stamp stamp, double acceleration);

  /// @return what is known so far.
  IdentifyResult result() const;

  /// @return readings that were kept out so far.
  RejectCounts rejected() const;

  const SuspensionMonitor& monitor() const { return monitor_; }
  const UniformGrid& grid() const { return grid_; }
  const TyreTracker* tyre() const { return tyre_ ? &*tyre_ : nullptr; }

 private:
  void take(const CornerSample& sample);
  IdentifiedStrut overTheDrive() const;

  UniformGrid grid_;
  SuspensionMonitor monitor_;
  std::optional<TyreTracker> tyre_;
  std::optional<InstrumentalVariables> whole_drive_;  // none: there are effects in the model
  Sink sink_;
};

}  // namespace suspension_health_monitor
