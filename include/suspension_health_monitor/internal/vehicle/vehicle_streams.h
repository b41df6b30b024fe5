#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/signal/grid_streams.h"
#include "suspension_health_monitor/internal/vehicle/strut_tops.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

namespace suspension_health_monitor {

/// The streams of a vehicle, numbered: those of the body's IMU if a strut needs it, then of every strut its sprung IMU,
/// if it has one, and its unsprung IMU, then the known forces.
struct VehicleStreams {
  enum class Place { kBody, kSprung, kUnsprung };

  struct Imu {
    std::string topic;
    Place place;
    std::size_t stream;   ///< its first: the body's IMU has six (VehicleChannels::body_imu), others one along the strut
    std::string setting;  ///< of the vehicle file that names the topic
  };

  /// @throws std::invalid_argument  if a strut without a sprung IMU has no position: its frame has not been looked up.
  explicit VehicleStreams(const VehicleLayout& layout);

  std::vector<StreamOptions> options;  ///< by stream, all required
  VehicleChannels channels;
  std::vector<Imu> imus;
};

}  // namespace suspension_health_monitor
