#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// A strut of a simulated vehicle with its wheel and tyre. The meaning of what users may set is in kVehicleStrutFields.
struct VehicleStrut {
  std::string name;
  double x = 0.0, y = 0.0, z = 0.0;  ///< top of the strut, from the centre of gravity; ahead, to the left, up [m]
  double damping = 0.0;              ///< [N s/m]
  double stiffness = 0.0;            ///< [N/m]
  double wheel_mass = 0.0;           ///< [kg]
  double tyre_stiffness = 0.0;       ///< [N/m]; 0: the wheel is rigid and has no mass of its own
  double tyre_damping = 0.0;         ///< [N s/m]

  double damping_end_fraction = 1.0;
  double stiffness_end_fraction = 1.0;
  double ramp_start = 0.0;  ///< when damping and stiffness begin to change [s]
  double ramp_end = 0.0;    ///< when they have changed [s]; at once if it is ramp_start

  /// End stops: springs that act only beyond a travel of +-gap [m]; stiffness over the own corner's mass [1/s^2], 0:
  /// there are none.
  double stop_gap = 0.0, stop_stiffness_to_mass = 0.0;

  double sprung_offset = 0.0;    ///< [m/s^2]
  double unsprung_offset = 0.0;  ///< [m/s^2]

  /// What the linear strut lacks, each as a force per own corner mass: c_j counts per 1 / a_ii (Vehicle::mobility).
  std::vector<ActiveEffect> hidden = {};

  /// @return what is left at time t of a number that goes to its share `end_fraction`.
  double shareAt(double t, double end_fraction) const;
  /// @param travel  d [m], compression positive.
  /// @return force of the end stops on the body per own corner mass [m/s^2], upwards in compression.
  double stopForceToMass(double travel) const;
  bool isRigid() const { return tyre_stiffness == 0.0; }
};

/// A spring that resists the difference of two struts' travels: + stiffness (d_first - d_second) on the body at the
/// first strut, the opposite at the second one, and both with the other sign on their wheels.
struct AntiRollBar {
  std::size_t first, second;  ///< places in Vehicle::struts
  double stiffness;           ///< [N/m]
};

/// A vertical force on the body that is measured: an actuator, a tow bar. Random, of even density within its band.
struct KnownForce {
  std::string name;
  double x = 0.0, y = 0.0;                                 ///< where it acts, from the centre of gravity [m]
  double rms = 0.0;                                        ///< [N]
  double lowest_frequency = 0.3, highest_frequency = 4.0;  ///< [Hz]
  double noise = 0.0;                                      ///< of its measurement [N]
};

/// The six-axis IMU of the body.
struct VehicleImu {
  double x = 0.0, y = 0.0, z = 0.0;           ///< from the centre of gravity [m]
  double roll = 0.0, pitch = 0.0, yaw = 0.0;  ///< from the body's axes to its own, Rz(yaw) Ry(pitch) Rx(roll) [rad]
  double offset_x = 0.0, offset_y = 0.0, offset_z = 0.0;                 ///< of its accelerometers [m/s^2]
  double gyro_offset_x = 0.0, gyro_offset_y = 0.0, gyro_offset_z = 0.0;  ///< [rad/s]

  Eigen::Vector3d position() const { return {x, y, z}; }
  Eigen::Matrix3d orientation() const;  ///< columns: its axes in the body's frame
};

/// A rigid body on struts, small angles. Body frame at the centre of gravity: x ahead, y to the left, z up (REP 103).
///
/// Degrees of freedom: heave; pitch about y, unless all struts have x = 0; roll about x, unless all have y = 0; the
/// height of every wheel. Positions count from the static equilibrium. With the force F_j of strut j on the body,
///   z_i'' = sum_j a_ij F_j,   a_ij = 1/M + x_i x_j / Iyy + y_i y_j / Ixx,
/// and so strut i's own b1 = a_ii c_i, b0 = a_ii k_i.
struct Vehicle {
  double mass = 0.0;            ///< of the body, M [kg]
  double pitch_inertia = 0.0;   ///< Iyy [kg m^2]; without meaning where all x are 0
  double roll_inertia = 0.0;    ///< Ixx [kg m^2]; without meaning where all y are 0
  std::string iso_class = "C";  ///< road that it is meant for
  double speed = 1.0;           ///< [m/s], likewise
  std::vector<VehicleStrut> struts = {};
  std::vector<AntiRollBar> anti_roll_bars = {};
  std::vector<KnownForce> known_forces = {};
  VehicleImu body_imu = {};

  bool pitches() const;  ///< some strut is ahead of or behind the centre of gravity
  bool rolls() const;    ///< some strut is beside it

  /// @return a_ij, vertical acceleration of the body at a strut per unit of the force of another (or its own) [1/kg].
  double mobility(const VehicleStrut& at, const VehicleStrut& of) const;

  /// @return place in `struts`.  @throws std::invalid_argument  naming the unknown name and the known ones.
  std::size_t strutNamed(const std::string& name) const;
};

inline constexpr OptionField<Vehicle> kVehicleFields[] = {
    {"vehicle", "mass", "kg", "of the body, without wheels", &Vehicle::mass, 1e-3, 1e9},
    {"vehicle", "pitch_inertia", "kg m^2", "of the body about y; not needed where all x are 0", &Vehicle::pitch_inertia,
     0.0, 1e12},
    {"vehicle", "roll_inertia", "kg m^2", "of the body about x; not needed where all y are 0", &Vehicle::roll_inertia,
     0.0, 1e12},
    {"vehicle", "iso_class", "-", "class of the road by ISO 8608, A smooth", &Vehicle::iso_class, 0, 0,
     "A B C D E F G H"},
    {"vehicle", "speed", "m/s", "it shakes up to 2.83 speed Hz", &Vehicle::speed, 0.01, 200.0},
};

inline constexpr OptionField<VehicleStrut> kVehicleStrutFields[] = {
    {"struts/NAME", "x", "m", "top of the strut, ahead of the centre of gravity", &VehicleStrut::x, -1e3, 1e3},
    {"struts/NAME", "y", "m", "to the left of it", &VehicleStrut::y, -1e3, 1e3},
    {"struts/NAME", "damping", "N s/m", "of the damper, c", &VehicleStrut::damping, 0.0, 1e9},
    {"struts/NAME", "stiffness", "N/m", "of the spring, k", &VehicleStrut::stiffness, 1e-6, 1e12},
    {"struts/NAME", "wheel_mass", "kg", "of wheel and carrier", &VehicleStrut::wheel_mass, 1e-6, 1e9},
    {"struts/NAME", "tyre_stiffness", "N/m", "of the tyre, which never lifts off; 0: the wheel is rigid",
     &VehicleStrut::tyre_stiffness, 0.0, 1e12},
    {"struts/NAME", "z", "m", "top of the strut, above the centre of gravity", &VehicleStrut::z, -1e3, 1e3},
    {"struts/NAME", "tyre_damping", "N s/m", "of the tyre", &VehicleStrut::tyre_damping, 0.0, 1e9},
    {"struts/NAME", "damping_end_fraction", "-", "share of the damping that is left from ramp_end on",
     &VehicleStrut::damping_end_fraction, 0.0, 10.0},
    {"struts/NAME", "stiffness_end_fraction", "-", "likewise of the stiffness", &VehicleStrut::stiffness_end_fraction,
     1e-3, 10.0},
    {"struts/NAME", "ramp_start", "s", "when damping and stiffness begin to change", &VehicleStrut::ramp_start, 0.0,
     1e6},
    {"struts/NAME", "ramp_end", "s", "when they have changed; ramp_start: at once", &VehicleStrut::ramp_end, 0.0, 1e6},
    {"struts/NAME", "sprung_offset", "m/s^2", "of the IMU at the strut's top", &VehicleStrut::sprung_offset, -100.0,
     100.0},
    {"struts/NAME", "unsprung_offset", "m/s^2", "of the IMU at the wheel", &VehicleStrut::unsprung_offset, -100.0,
     100.0},
};
/// So many of the rows, the first ones, a model file must give for every strut.
inline constexpr std::size_t kRequiredStrutFields = 6;

inline constexpr OptionField<KnownForce> kKnownForceFields[] = {
    {"known_forces/NAME", "x", "m", "where it acts, ahead of the centre of gravity", &KnownForce::x, -1e3, 1e3},
    {"known_forces/NAME", "y", "m", "to the left of it", &KnownForce::y, -1e3, 1e3},
    {"known_forces/NAME", "rms", "N", "size of the force, which is vertical and random", &KnownForce::rms, 0.0, 1e9},
    {"known_forces/NAME", "lowest_frequency", "Hz", "of its band", &KnownForce::lowest_frequency, 1e-3, 1e3},
    {"known_forces/NAME", "highest_frequency", "Hz", "of its band", &KnownForce::highest_frequency, 1e-3, 1e3},
    {"known_forces/NAME", "noise", "N", "standard deviation of its measurement's white noise", &KnownForce::noise, 0.0,
     1e9},
};

inline constexpr OptionField<VehicleImu> kVehicleImuFields[] = {
    {"body_imu", "x", "m", "place, ahead of the centre of gravity", &VehicleImu::x, -1e3, 1e3},
    {"body_imu", "y", "m", "to the left of it", &VehicleImu::y, -1e3, 1e3},
    {"body_imu", "z", "m", "above it", &VehicleImu::z, -1e3, 1e3},
    {"body_imu", "roll", "rad", "how it is mounted: Rz(yaw) Ry(pitch) Rx(roll)", &VehicleImu::roll, -7.0, 7.0},
    {"body_imu", "pitch", "rad", "likewise", &VehicleImu::pitch, -7.0, 7.0},
    {"body_imu", "yaw", "rad", "likewise", &VehicleImu::yaw, -7.0, 7.0},
    {"body_imu", "offset_x", "m/s^2", "of its accelerometer on x", &VehicleImu::offset_x, -100.0, 100.0},
    {"body_imu", "offset_y", "m/s^2", "on y", &VehicleImu::offset_y, -100.0, 100.0},
    {"body_imu", "offset_z", "m/s^2", "on z", &VehicleImu::offset_z, -100.0, 100.0},
    {"body_imu", "gyro_offset_x", "rad/s", "of its gyro about x", &VehicleImu::gyro_offset_x, -1.0, 1.0},
    {"body_imu", "gyro_offset_y", "rad/s", "about y", &VehicleImu::gyro_offset_y, -1.0, 1.0},
    {"body_imu", "gyro_offset_z", "rad/s", "about z", &VehicleImu::gyro_offset_z, -1.0, 1.0},
};

/// Checks ranges, that the struts hold the body (three that are not in a line; two, if the centre of gravity is between
/// them on the line and one axis; or one below it), and what acts on what.
/// @throws std::invalid_argument  naming option, value and what is allowed.
void validate(const Vehicle& vehicle);

/// @return names of the vehicles that namedVehicle() knows, with commas.
std::string vehicleNames();

/// @throws std::invalid_argument  naming the unknown name and the known ones.
Vehicle namedVehicle(std::string_view name);

}  // namespace suspension_health_monitor
