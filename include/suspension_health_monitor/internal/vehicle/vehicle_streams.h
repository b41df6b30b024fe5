#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/signal/grid_streams.h"
#include "suspension_health_monitor/internal/vehicle/strut_tops.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

namespace suspension_health_monitor {

/// The streams of a vehicle, numbered: those of the body's IMU if a strut needs it, then of every strut its sprung IMU,
/// if it has one, and its unsprung IMU, then that of the road, then the known forces, those of one topic after another.
struct VehicleStreams {
  enum class Place { kBody, kSprung, kUnsprung, kForce, kRoad };

  /// An IMU, or what measures known forces.
  struct Sensor {
    std::string topic;
    Place place;
    /// Its first: the body's IMU has six (VehicleChannels::body_imu), other IMUs one along the strut, others one for
    /// each force.
    std::size_t stream;
    std::string setting;                   ///< of the vehicle file that names the topic
    std::vector<std::size_t> fields = {};  ///< that are its forces, in kWrenchFields
  };

  /// @throws std::invalid_argument  if a strut without a sprung IMU has no position: its frame has not been looked up.
  explicit VehicleStreams(const VehicleLayout& layout);

  std::vector<StreamOptions> options;  ///< by stream, all required but the road
  VehicleChannels channels;
  std::vector<Sensor> sensors;  ///< the IMUs, then the others

  /// @return the sensor that is a strut's body IMU: its own, or that of the body.
  std::size_t bodyImuOf(std::size_t strut) const;
  std::size_t wheelImuOf(std::size_t strut) const { return options[channels.struts[strut].unsprung].sensor; }

 private:
  void addForces(const std::vector<VehicleLayout::KnownForce>& forces);
};

}  // namespace suspension_health_monitor
