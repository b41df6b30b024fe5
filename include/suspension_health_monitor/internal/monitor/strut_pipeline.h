#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"
#include "suspension_health_monitor/internal/signal/early_readings.h"
#include "suspension_health_monitor/internal/signal/uniform_grid.h"

namespace suspension_health_monitor {

/// From the readings of a strut's sensors to reports, the one way for a live robot, a bag, arrays and tests:
/// reading -> UniformGrid -> sample -> TyreTracker, SuspensionMonitor::addSample -> sinks.
/// Without a sample_period the first readings wait until their stamps have told it; until then there is no monitor.
/// Cost per reading: O(1) amortised; after the sample period is known no allocation and no lock.
class StrutPipeline {
 public:
  struct Sinks {
    std::function<void(const MonitorReport&)> report;  ///< after every sample that gave one
    std::function<void(const CornerSample&)> sample;   ///< after every sample, those included that the monitor rejects
  };

  /// @throws std::invalid_argument  as MonitorOptions::validate().
  StrutPipeline(const MonitorSettings& settings, Sinks sinks);

  /// Takes in one reading of one sensor; each stream comes in the order in which it was measured.
  /// @param acceleration  along the strut, up positive [m/s^2].
  /// @throws std::invalid_argument  once, if settings or effects do not fit the sample period that was measured: no
  /// reading counts any more. What a sink throws comes out, too; no reading is lost by it.
  void push(Side side, Stamp stamp, double acceleration);

  /// As SuspensionMonitor::setEffects().
  void setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut = {});

  /// @throws std::invalid_argument  if a value of it is not above 0 and finite.
  void setBaseline(const Baseline& baseline);

  /// @return what health is judged by, or will be; empty as long as nothing was given or learned.
  Baseline baseline() const { return monitor_ ? monitor_->baseline() : baseline_.value_or(Baseline{}); }

  /// As SuspensionMonitor::reconfigure().
  void reconfigure(const MonitorSettings& settings);

  /// @return as SuspensionMonitor::overTheDrive().
  StrutEstimate overTheDrive() { return monitor_ ? monitor_->overTheDrive() : StrutEstimate(); }

  /// @return nullptr while the sample period is being measured; so with the next two.
  const SuspensionMonitor* monitor() const { return monitor_ ? &*monitor_ : nullptr; }
  const UniformGrid* grid() const { return grid_ ? &*grid_ : nullptr; }
  const TyreTracker* tyre() const { return tyre_ ? &*tyre_ : nullptr; }  ///< nullptr without a road sensor, too

  /// @return readings that were kept out so far, wherever it was noticed.
  RejectCounts rejected() const;

 private:
  void start(double period);
  void startOnce(double period);
  void replayEarly();
  void take(Side side, Stamp stamp, double acceleration);

  MonitorSettings settings_;
  Sinks sinks_;
  EarlyReadings<double> early_{PeriodMeasurement::kOfOneStrut, StreamGrid::kMostWaiting};
  bool is_refused_ = false;            // the settings do not fit the sample period that was measured
  std::vector<ActiveEffect> effects_;  // until there is a monitor, as is the baseline
  std::optional<LinearStrut> strut_;   // that belongs to them
  std::optional<Baseline> baseline_;
  std::optional<UniformGrid> grid_;
  std::optional<SuspensionMonitor> monitor_;
  std::optional<TyreTracker> tyre_;
};

}  // namespace suspension_health_monitor
