#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/stream_grid.h"
#include "suspension_health_monitor/internal/signal/white_level.h"
#include "suspension_health_monitor/internal/vehicle/gravity.h"
#include "suspension_health_monitor/internal/vehicle/strut_tops.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// The readings of all sensors of a vehicle as samples of its struts, the one way for a live vehicle and for bags:
/// StreamGrid -> StrutTops. Where the body's IMU is needed readings wait until it is known how the IMU is turned
/// (BodyLevel): for ten seconds in which the vehicle neither brakes nor pulls away, or for half a minute. Cost per
/// reading: as StreamGrid, after these seconds no allocation.
class VehicleGrid {
 public:
  using Sink = std::function<void(const VehicleSample&)>;
  using ReadingSink = std::function<void(const VehicleReading&)>;

  /// @param options  of a strut; before an instant is of use the filter of the strut tops fills, too.
  /// @param sink  called with every sample.
  /// @param readings  called with every reading that was taken in, with the time at which it was taken (StreamClock);
  /// those of the body's IMU are turned upright.
  /// @throws std::invalid_argument  as StreamGrid and StrutTops.
  VehicleGrid(double period, const VehicleStreams& streams, const GridOptions& options, Sink sink,
              ReadingSink readings = {});

  /// Takes in one message of a sensor.
  /// @param sensor  its place in VehicleStreams::sensors.  @param values  of its streams.
  /// @return true if the grid has begun to resample: the newest kSignalTuning.outcomes samples were badly paired,
  /// and a record is better without them.
  bool push(std::size_t sensor, Stamp stamp, const double* values);
  bool push(std::size_t sensor, Stamp stamp, const std::vector<double>& values) {
    return push(sensor, stamp, values.data());
  }

  /// After the last reading: what waits is led on.
  void finish() {
    if (!waiting_.empty()) turnUpright(levelSince(0));
  }

  const StreamGrid& streams() const { return grid_; }

  /// @return what is measured of the vehicle, in the axes of the readings.
  const VehicleChannels& vehicle() const { return vehicle_; }

  /// @return how the body's IMU was found to be turned.
  const BodyLevel& bodyLevel() const { return level_; }

  /// @return what timing and losses of a sensor are judged by: all of its streams share their stamps.
  const StreamGate& gate(std::size_t sensor) const { return grid_.gate(sensors_[sensor].stream); }

  /// @return readings of a sensor that were kept out, and what was lost for want of its readings.
  RejectCounts rejected(std::size_t sensor) const;
  std::uint64_t missed(std::size_t sensor) const;

  /// Writes down what the samples of a drive have gone through: the taps of their filter, and what the sensors' noise
  /// makes of the samples. The noise of the body's IMU is the measured one; until enough was read that of
  /// kVehicleTuning. Allocates.
  void describe(VehicleDrive& drive) const;

  /// @return instants of the grid so far.
  std::uint64_t numInstants() const { return num_instants_; }

 private:
  using Place = VehicleStreams::Place;

  void lead(const VehicleStreams::Sensor& sensor, const double* values, Stamp taken);
  void give(VehicleReading reading);
  void take(const GridInstant& instant);
  void lead(const GridInstant& instant);
  BodyLevel levelSince(std::size_t first) const;
  void turnUpright(const BodyLevel& level);

  Stamp period_;
  VehicleChannels vehicle_;
  StrutTops tops_;
  BodyLevel level_;
  std::size_t level_window_ = 0;  // instants that a level is taken of
  std::size_t num_to_wait_ = 0;   // instants until it is
  std::vector<GridInstant> waiting_;
  std::vector<VehicleReading> waiting_readings_;
  StreamGrid grid_;
  std::vector<VehicleStreams::Sensor> sensors_;
  std::vector<WhiteLevel> body_levels_;  // of the body's IMU, by stream
  std::optional<Stamp> last_;
  std::uint64_t num_instants_ = 0;
  Sink sink_;
  ReadingSink readings_;
};

}  // namespace suspension_health_monitor
