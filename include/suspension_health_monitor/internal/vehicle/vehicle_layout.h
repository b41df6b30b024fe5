#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

namespace suspension_health_monitor {

/// The fields of a geometry_msgs/Wrench that may be a known force.
inline constexpr std::array<std::string_view, 6> kWrenchFields{"force.x",  "force.y",  "force.z",
                                                               "torque.x", "torque.y", "torque.z"};

/// Which sensors a vehicle has, and where, as a vehicle file says it.
struct VehicleLayout {
  struct Strut {
    std::string name;  ///< a name that a topic may begin with
    std::string unsprung_imu;
    std::optional<std::string> sprung_imu;  ///< none: the body's IMU tells what the strut's top does
    /// Of the strut's top, from the body's IMU, in that IMU's axes or, with a target_frame, in those of that frame [m].
    /// Where every strut has its own IMU: from any point of the body, x forward, y to the left, z up (REP 103).
    std::optional<std::array<double, 3>> position;
    std::optional<std::string> frame;  ///< at the strut's top, whose static transform tells the position
  };
  struct KnownForce {
    std::string name;
    std::string topic;  ///< of geometry_msgs/WrenchStamped; several forces may share it
    std::size_t field;  ///< of its messages, in kWrenchFields
  };

  std::optional<std::string> body_imu;  ///< topic, as are the others
  std::vector<Strut> struts;            ///< by the alphabet
  std::vector<KnownForce> known_forces;
  std::optional<std::string> road_imu;  ///< of the road under a strut alone

  /// One strut without a name, whose topics are those of a monitor of one strut.
  static VehicleLayout ofOneStrut(bool has_road);

  /// @return true if transforms are to tell where a strut is.
  bool hasFrames() const {
    return std::any_of(struts.begin(), struts.end(), [](const Strut& strut) { return strut.frame.has_value(); });
  }

  /// Turns the axes of all positions.
  /// @param mount  into which: of BodyLevel.
  void turn(const Eigen::Matrix3d& mount);
};

/// Takes the settings of a vehicle file out of `values`: `body_imu`, `struts/NAME/...` and `known_forces/NAME/...`.
/// @throws std::invalid_argument  naming what is missing, unknown, wrong, or said of two sensors.
VehicleLayout takeVehicle(OptionMap& values);

/// @throws std::invalid_argument  naming two struts that have one position.
void requireApart(const VehicleLayout& layout);

/// The streams of a vehicle, numbered: those of the body's IMU if a strut needs it, then of every strut its sprung IMU,
/// if it has one, and its unsprung IMU, then that of the road, then the known forces, those of one topic after another.
struct VehicleStreams {
  using Place = VehicleReading::Sensor;

  /// An IMU, or what measures known forces.
  struct Sensor {
    std::string topic;
    Place place;
    /// Its first: the body's IMU has six (VehicleChannels::body_imu), other IMUs one along the strut, others one for
    /// each force.
    std::size_t stream;
    std::size_t count;                     ///< of its streams
    std::size_t strut;                     ///< of an IMU of a strut its place
    std::string setting;                   ///< of the vehicle file that names the topic
    std::vector<std::size_t> fields = {};  ///< that are its forces, in kWrenchFields
    std::vector<std::size_t> forces = {};  ///< these, by their places among the known forces
  };

  /// @throws std::invalid_argument  if a strut without a sprung IMU has no position: its frame has not been looked up.
  explicit VehicleStreams(const VehicleLayout& layout);

  std::vector<StreamOptions> options;  ///< by stream, all required but the road
  VehicleChannels channels;
  std::vector<Sensor> sensors;  ///< the IMUs, then the others

  /// @return the sensor that is a strut's body IMU: its own, or that of the body.
  std::size_t bodyImuOf(std::size_t strut) const {
    const std::optional<std::size_t>& own = channels.struts[strut].sprung;
    return options[own ? *own : *channels.body_imu].sensor;
  }
  std::size_t wheelImuOf(std::size_t strut) const { return options[channels.struts[strut].unsprung].sensor; }
};

}  // namespace suspension_health_monitor
