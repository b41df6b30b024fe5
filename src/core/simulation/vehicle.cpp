#include "suspension_health_monitor/internal/simulation/vehicle.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <stdexcept>

#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/prefixed.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

/// Heave, pitch, roll: as many as the vehicle has.
int motionsOf(const Vehicle& vehicle) { return 1 + (vehicle.pitches() ? 1 : 0) + (vehicle.rolls() ? 1 : 0); }

void requireHeld(const Vehicle& vehicle) {
  Eigen::MatrixXd pushes(vehicle.struts.size(), 3);
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i)
    pushes.row(static_cast<Eigen::Index>(i)) << 1.0, vehicle.struts[i].x, vehicle.struts[i].y;
  if (pushes.colPivHouseholderQr().rank() < motionsOf(vehicle))
    throw std::invalid_argument(
        "the struts do not hold the body, must be three that are not in a line, or all on one axis through the centre "
        "of gravity, at least two");
}

void validate(const VehicleStrut& strut) {
  validate(strut, kVehicleStrutFields);
  if (strut.ramp_end < strut.ramp_start)
    refuse("ramp_end", strut.ramp_end, "s", formatted("at least ramp_start = %g", strut.ramp_start));
}

void validate(const KnownForce& force, const Vehicle& vehicle) {
  validate(force, kKnownForceFields);
  if (force.highest_frequency <= force.lowest_frequency)
    refuse("highest_frequency", force.highest_frequency, "Hz",
           formatted("above lowest_frequency = %g", force.lowest_frequency));
  if (force.x != 0.0 && !vehicle.pitches()) refuse("x", force.x, "m", "0: this vehicle does not pitch");
  if (force.y != 0.0 && !vehicle.rolls()) refuse("y", force.y, "m", "0: this vehicle does not roll");
}

}  // namespace

double EndStops::forcePerMass(double travel) const {
  return stiffness_to_mass * (std::max(0.0, travel - gap) + std::min(0.0, travel + gap));
}

double VehicleStrut::shareAt(double t, double end_fraction) const {
  if (t < ramp_start) return 1.0;
  if (t >= ramp_end) return end_fraction;
  return 1.0 + (t - ramp_start) / (ramp_end - ramp_start) * (end_fraction - 1.0);
}

Eigen::Matrix3d VehicleImu::orientation() const {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
          AngleAxisd(roll, Vector3d::UnitX()))
      .toRotationMatrix();
}

bool Vehicle::pitches() const {
  return std::any_of(struts.begin(), struts.end(), [](const VehicleStrut& strut) { return strut.x != 0.0; });
}

bool Vehicle::rolls() const {
  return std::any_of(struts.begin(), struts.end(), [](const VehicleStrut& strut) { return strut.y != 0.0; });
}

double Vehicle::mobility(double x, double y, double x_force, double y_force) const {
  double sum = 1.0 / mass;
  if (pitches()) sum += x * x_force / pitch_inertia;
  if (rolls()) sum += y * y_force / roll_inertia;
  return sum;
}

std::size_t Vehicle::strutNamed(const std::string& name) const {
  const std::vector<std::string> known = namesOf(struts);
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) throw std::invalid_argument("strut " + shortened(name) + ", must be one of " + join(known));
  return static_cast<std::size_t>(found - known.begin());
}

void validate(const Vehicle& vehicle) {
  validate(vehicle, kVehicleFields);
  if (vehicle.struts.empty()) throw std::invalid_argument("the vehicle has no strut, must be at least one");
  if (vehicle.pitches() && vehicle.pitch_inertia <= 0.0)
    refuse("pitch_inertia", vehicle.pitch_inertia, "kg m^2", "above 0");
  if (vehicle.rolls() && vehicle.roll_inertia <= 0.0) refuse("roll_inertia", vehicle.roll_inertia, "kg m^2", "above 0");
  requireHeld(vehicle);
  for (const VehicleStrut& strut : vehicle.struts) prefixed("struts/" + strut.name + ": ", [&] { validate(strut); });
  for (const KnownForce& force : vehicle.known_forces)
    prefixed("known_forces/" + force.name + ": ", [&] { validate(force, vehicle); });
  for (const AntiRollBar& bar : vehicle.anti_roll_bars)
    if (bar.first == bar.second)
      throw std::invalid_argument("anti_roll_bars/" + vehicle.struts.at(bar.first).name +
                                  " leads to the same strut, must be two struts");
  prefixed("body_imu: ", [&] { validate(vehicle.body_imu, kVehicleImuFields); });
}

}  // namespace suspension_health_monitor
