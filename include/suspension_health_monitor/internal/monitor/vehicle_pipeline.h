#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"
#include "suspension_health_monitor/internal/monitor/vehicle_monitor.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// From the readings of a vehicle's sensors to reports by strut, the one way for a live robot, a bag, arrays and tests;
/// one strut is a vehicle with one strut:
/// reading -> VehicleGrid -> VehicleMonitor::addReading; sample -> TyreTracker, VehicleMonitor::addGridSample -> sinks.
/// Without a sample_period the first readings wait until their stamps have told it; until then nothing is monitored.
/// Cost per reading: O(1) amortised; after the sample period is known no allocation and no lock.
class VehiclePipeline {
 public:
  struct Sinks {
    VehicleMonitor::Sink report;                       ///< after every sample that gave one
    std::function<void(const VehicleSample&)> sample;  ///< after every sample, those included that monitors reject
  };

  /// @param settings  by strut; sample_period and what is of the grid are those of the first.
  /// @throws std::invalid_argument  as MonitorOptions::validate(), VehicleMonitor and VehicleGrid.
  VehiclePipeline(const std::vector<MonitorSettings>& settings, const VehicleStreams& streams, Sinks sinks);

  /// Of one strut, whose sensors are numbered by Side.
  explicit VehiclePipeline(const MonitorSettings& settings, std::function<void(const MonitorReport&)> report = {});
  VehiclePipeline(const VehiclePipeline&) = delete;  // sinks refer to it
  VehiclePipeline& operator=(const VehiclePipeline&) = delete;

  /// Takes in one reading of one sensor; each sensor comes in the order in which it measured.
  /// @param sensor  its place in VehicleStreams::sensors.  @param values  of its streams.
  /// @throws std::invalid_argument  once, if settings or effects do not fit the sample period that was measured: no
  /// reading counts any more. What a sink throws comes out, too; no reading is lost by it.
  void push(std::size_t sensor, Stamp stamp, const double* values);

  /// The same of one strut; the road's readings are left out if nobody asks for them.
  void push(Side side, Stamp stamp, double acceleration) {
    if (indexOf(side) < streams_.sensors.size()) push(indexOf(side), stamp, &acceleration);
  }

  /// After the last reading of a recording.
  void finish();

  /// As VehicleMonitor, of one strut.
  void setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& start = {},
                  std::size_t strut = 0) {
    monitor_.setEffects(strut, effects, start);
  }
  void setBaseline(const Baseline& baseline, std::size_t strut = 0) { monitor_.setBaseline(strut, baseline); }
  Baseline baseline(std::size_t strut = 0) const { return monitor_.baseline(strut); }
  void reconfigure(const MonitorSettings& settings, std::size_t strut = 0) { monitor_.reconfigure(strut, settings); }
  StrutEstimate overTheDrive(std::size_t strut = 0) { return grid_ ? monitor_.overTheDrive(strut) : StrutEstimate(); }

  /// @return nullptr while the sample period is being measured; so with the next three.
  VehicleMonitor* monitor() { return grid_ ? &monitor_ : nullptr; }
  const VehicleMonitor* monitor() const { return grid_ ? &monitor_ : nullptr; }
  const VehicleGrid* grid() const { return grid_ ? &*grid_ : nullptr; }
  const TyreTracker* tyre() const { return tyre_ ? &*tyre_ : nullptr; }  ///< nullptr without a road sensor, too

  /// @return nullptr also while the rows of a vehicle are not known.
  const SuspensionMonitor* strut(std::size_t i = 0) const { return grid_ ? monitor_.strut(i) : nullptr; }

  /// @return T [s], once there is a monitor.
  std::optional<double> period() const { return grid_ ? monitor_.settings().sample_period : std::nullopt; }
  Stamp newest() const { return newest_; }  ///< stamp of the newest sample; 0 before the first

  /// @return readings of a sensor, or of all, that were kept out so far, wherever it was noticed.
  RejectCounts rejected(std::size_t sensor) const;
  RejectCounts rejected() const;

 private:
  void start();
  void startOnce(double period);
  void take(const VehicleSample& sample);

  VehicleStreams streams_;
  Sinks sinks_;
  VehicleMonitor monitor_;
  FirstReadings first_readings_;     // by sensor
  bool is_refused_ = false;          // the settings do not fit the sample period that was measured
  std::optional<VehicleGrid> grid_;  // once the sample period is known
  std::optional<TyreTracker> tyre_;
  Stamp newest_{};
};

}  // namespace suspension_health_monitor
