#include "suspension_health_monitor/internal/simulation/vehicle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/simulation/vehicle_simulator.h"

namespace suspension_health_monitor {
namespace {

void requireHeld(const Vehicle& vehicle) {
  Eigen::MatrixXd pushes(vehicle.struts.size(), 3);
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i)
    pushes.row(i) << 1.0, vehicle.struts[i].x, vehicle.struts[i].y;
  const int motions = 1 + (vehicle.pitches() ? 1 : 0) + (vehicle.rolls() ? 1 : 0);
  if (rankOf(pushes) < motions)
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

double VehicleStrut::shareAt(double t, double end_fraction) const {
  if (t < ramp_start) return 1.0;
  if (t >= ramp_end) return end_fraction;
  return 1.0 + (t - ramp_start) / (ramp_end - ramp_start) * (end_fraction - 1.0);
}

double VehicleStrut::stopForceToMass(double travel) const {
  return stop_stiffness_to_mass * (std::max(0.0, travel - stop_gap) + std::min(0.0, travel + stop_gap));
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

double Vehicle::mobility(const VehicleStrut& at, const VehicleStrut& of) const {
  double sum = 1.0 / mass;
  if (pitches()) sum += at.x * of.x / pitch_inertia;
  if (rolls()) sum += at.y * of.y / roll_inertia;
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

namespace {

using NamedVehicle = std::pair<std::string, Vehicle>;

Vehicle onStruts(Vehicle body, const std::vector<VehicleStrut>& struts) {
  body.struts = struts;
  return body;
}

/// @param front, rear  the struts on the left; those on the right are alike.
Vehicle onFourWheels(Vehicle body, const VehicleStrut& front, const VehicleStrut& rear) {
  for (const VehicleStrut& left : {front, rear})
    for (const double side : {1.0, -1.0}) {
      VehicleStrut& strut = body.struts.emplace_back(left);
      strut.name += side > 0.0 ? "_left" : "_right";
      strut.y *= side;
    }
  return body;
}

// Plausible numbers of our own: every strut by itself 1.3 to 2.5 Hz with a damping ratio of 0.22 to 0.35, wheel hop 9
// to 14 Hz, front and rear different, the body IMU where there is room for it. No anti-roll bars: they are to be
// hidden.
const std::vector<NamedVehicle>& namedVehicles() {
  static const std::vector<NamedVehicle> vehicles{
      {"sedan", onFourWheels({1350.0, 2100.0, 480.0, "C", 15.0, {}, {}, {}, {0.2, -0.1, 0.05}},
                             {"front", 1.15, 0.75, 0.35, 1930.0, 26000.0, 41.0, 205000.0, 150.0},
                             {"rear", -1.45, 0.73, 0.3, 1790.0, 29000.0, 37.0, 205000.0, 150.0})},
      {"ugv", onFourWheels({24.0, 1.1, 0.75, "D", 4.0, {}, {}, {}, {-0.06, 0.03, 0.08}},
                           {"front", 0.34, 0.27, 0.04, 34.0, 780.0, 1.2, 9000.0, 6.0},
                           {"rear", -0.28, 0.27, 0.04, 52.0, 1180.0, 1.2, 9000.0, 6.0})},
      {"truck", onFourWheels({6500.0, 24000.0, 6000.0, "C", 16.0, {}, {}, {}, {1.4, 0.3, 0.4}},
                             {"front", 2.1, 1.0, 0.1, 9300.0, 176000.0, 300.0, 850000.0, 600.0},
                             {"rear", -1.8, 0.93, -0.1, 12100.0, 329000.0, 550.0, 1700000.0, 1200.0})},
      {"half_sedan", onStruts({675.0, 800.0, 0.0, "C", 15.0, {}, {}, {}, {0.2, 0.0, 0.05}},
                              {{"front", 1.15, 0.0, 0.35, 1930.0, 26000.0, 41.0, 205000.0, 150.0},
                               {"rear", -1.45, 0.0, 0.3, 1790.0, 29000.0, 37.0, 205000.0, 150.0}})},
  };
  return vehicles;
}

}  // namespace

std::string vehicleNames() { return join(mapped(namedVehicles(), &NamedVehicle::first)); }

Vehicle namedVehicle(std::string_view name) {
  for (const NamedVehicle& named : namedVehicles())
    if (named.first == name) return named.second;
  throw std::invalid_argument("vehicle model " + shortened(std::string(name)) + ", must be one of " + vehicleNames());
}

namespace {

constexpr double kStiffest = 1e12;  // [N/m]

void changeStrut(OptionMap& values, const EffectLibrary& library, VehicleStrut& strut) {
  const std::string group = "struts/" + strut.name;
  prefixed(group + ": ", [&] {
    for (ActiveEffect& effect : takeEffects(values, library.forces)) {
      const auto same = [&](const ActiveEffect& there) { return there.effect.name == effect.effect.name; };
      strut.hidden.erase(std::remove_if(strut.hidden.begin(), strut.hidden.end(), same), strut.hidden.end());
      strut.hidden.push_back(std::move(effect));
    }
  });
  takeAll(group, values, kVehicleStrutFields, strut);
}

void changeBars(OptionMap& values, Vehicle& vehicle) {
  std::vector<AntiRollBar>& bars = vehicle.anti_roll_bars;
  const auto place = [&](const std::string& strut) {
    return prefixed("anti_roll_bars: ", [&] { return vehicle.strutNamed(strut); });
  };
  for (const auto& [name, others] : takeGroups(values, "anti_roll_bars"))
    for (const auto& [other, given] : others) {
      const double stiffness = toNumber("anti_roll_bars/" + name + '/' + other, given, 0.0, kStiffest);
      const AntiRollBar bar{place(name), place(other), stiffness};
      const auto same = [&](const AntiRollBar& there) {
        return std::minmax(there.first, there.second) == std::minmax(bar.first, bar.second);
      };
      bars.erase(std::remove_if(bars.begin(), bars.end(), same), bars.end());
      bars.push_back(bar);
    }
}

void changeKnownForces(OptionMap& values, Vehicle& vehicle) {
  for (auto& [name, settings] : takeGroups(values, "known_forces")) {
    requireName("known_forces/" + shortened(name), name);
    std::vector<KnownForce>& forces = vehicle.known_forces;
    const auto same = [&, &wanted = name](const KnownForce& force) { return force.name == wanted; };
    auto force = std::find_if(forces.begin(), forces.end(), same);
    if (force == forces.end()) {
      force = forces.emplace(forces.end());
      force->name = name;
    }
    takeAll("known_forces/" + name, settings, kKnownForceFields, *force);
  }
}

void requireGiven(const std::string& prefix, const OptionMap& values, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (values.count(name) == 0)
      throw std::invalid_argument(prefix + name + " is missing; must be given: " + join(names));
}

}  // namespace

void changeVehicle(OptionMap& values, const EffectLibrary& library, Vehicle& vehicle) {
  takeOptions(values, kVehicleFields, vehicle);
  for (auto& [name, settings] : takeGroups(values, "struts"))
    changeStrut(settings, library, vehicle.struts[vehicle.strutNamed(name)]);
  changeBars(values, vehicle);
  changeKnownForces(values, vehicle);
  takeAll("body_imu", takePrefixed(values, "body_imu"), kVehicleImuFields, vehicle.body_imu);
}

Vehicle takeVehicle(OptionMap& values, const EffectLibrary& library) {
  Vehicle vehicle;
  requireGiven("", values, {"mass", "speed"});
  std::vector<std::string> required;
  for (std::size_t i = 0; i < kRequiredStrutFields; ++i) required.emplace_back(kVehicleStrutFields[i].name);
  OptionMap named = values;
  for (const auto& [name, settings] : takeGroups(named, "struts")) {
    requireName("struts/" + shortened(name), name);
    requireGiven("struts/" + name + ": ", settings, required);
    vehicle.struts.emplace_back().name = name;
  }
  changeVehicle(values, library, vehicle);
  validate(vehicle);
  return vehicle;
}

}  // namespace suspension_health_monitor
