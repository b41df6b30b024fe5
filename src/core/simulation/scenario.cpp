#include "suspension_health_monitor/internal/simulation/scenario.h"

#include <algorithm>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/simulation/sensors.h"

namespace suspension_health_monitor {
namespace {

/// A vehicle and the road it is meant for.
struct ScenarioVehicle {
  std::string_view name;
  QuarterCar car;
  char iso_class;
  double speed;  // [m/s]
};

// paper: section 4, non-pneumatic tyres, hence a rigid wheel.
// golden_car: the reference quarter car of the International Roughness Index (Sayers, "On the calculation of
//   International Roughness Index from longitudinal road profile", TRR 1501, 1995): beta/M = 6.0 1/s, K/M = 63.3 1/s^2,
//   K0/M = 653 1/s^2, m/M = 0.15; only ratios are given there, M = 250 kg is ours.
// rover, ugv: our own choice of a small slow rover (body 1.7 Hz) and of a softer, faster one (1.0 Hz) on bad ground,
//   with the golden car's ratio K0/K of about 10.
constexpr ScenarioVehicle kVehicles[] = {
    {"paper", {50.0, 5.0, 150.0, 690.0, std::nullopt}, 'C', 5.0},
    {"golden_car", {250.0, 37.5, 1500.0, 15825.0, 163250.0}, 'C', 15.0},
    {"rover", {10.0, 2.0, 50.0, 1200.0, 12000.0}, 'E', 2.0},
    {"ugv", {50.0, 7.5, 200.0, 2000.0, 20000.0}, 'D', 6.0},
};

// The paper leaves its limit open. These stops are reached on its bumps only: 50 000 N/m on its 50 kg.
constexpr EndStops kPaperStops{0.09, 1000.0};
constexpr TimeWindow kPaperLosses[] = {{25.0, 26.0}, {65.0, 66.0}};
constexpr double kPaperDampingLeft = 100.0 / 150.0;

const ScenarioVehicle& findVehicle(const SimulationOptions& options) {
  std::string_view name = options.vehicle;
  if (name == "default") name = options.scenario == "iso_road" ? "golden_car" : "paper";
  return *std::find_if(std::begin(kVehicles), std::end(kVehicles), [&](const auto& v) { return v.name == name; });
}

VehicleStrut strutOf(const QuarterCar& car, const SimulationOptions& options) {
  VehicleStrut strut;
  strut.damping = car.damping;
  strut.stiffness = car.stiffness;
  strut.wheel_mass = car.unsprung_mass;
  strut.tyre_stiffness = car.tyre_stiffness.value_or(0.0);
  strut.damping_end_fraction =
      options.damping_end_fraction.value_or(options.scenario == "iso_road" ? 1.0 : kPaperDampingLeft);
  strut.ramp_start = options.ramp_start;
  strut.ramp_end = options.ramp_end;
  if (options.scenario == "paper_saturation") strut.end_stops = kPaperStops;
  strut.hidden = options.hidden;
  return strut;
}

Road makeRoad(const SimulationOptions& options, const ScenarioVehicle& vehicle) {
  if (options.scenario == "iso_road") {
    const char iso_class = options.iso_class == "default" ? vehicle.iso_class : options.iso_class.front();
    return IsoRoad(iso_class, options.speed.value_or(vehicle.speed), options.seed);
  }
  if (options.scenario == "paper_saturation") return [](double t) { return paperRoad(t) + paperBumps(t); };
  return paperRoad;
}

}  // namespace

void validate(const SimulationOptions& options) {
  validate(options, kSimulationFields);
  if (options.ramp_end <= options.ramp_start)
    refuse("ramp_end", options.ramp_end, "s", formatted("later than ramp_start = %g", options.ramp_start));
  const double shortest = 1.0 / fasterRate(options);
  if (options.stamp_jitter >= shortest)
    refuse("stamp_jitter", options.stamp_jitter, "s",
           formatted("less than one sample period, 1 / rate = %g", shortest));
  if (options.sampling_jitter > 0.0 && options.sampling_jitter >= shortest - options.stamp_jitter)
    refuse("sampling_jitter", options.sampling_jitter, "s",
           formatted("less than one sample period, 1 / rate, less stamp_jitter = %g", shortest - options.stamp_jitter));
  if (options.hidden.size() > kMostHiddenEffects)
    refuse("number of hidden effects", static_cast<double>(options.hidden.size()), "",
           "at most " + std::to_string(kMostHiddenEffects));
  const SimulatedFaults faults = SimulatedFaults::from(options.hidden_faults);
  const auto acts = [](const std::array<double, 2>& sizes) { return sizes[0] != 0.0 || sizes[1] != 0.0; };
  if (acts(faults.tilt) && options.body_acceleration == 0.0)
    refuse("body_acceleration", 0.0, "m/s^2", "above 0 for mount_tilt to show");
  if (acts(faults.position) && options.body_rate == 0.0)
    refuse("body_rate", 0.0, "rad/s", "above 0 for lever_arm to show");
}

double fasterRate(const SimulationOptions& options) {
  return std::max(options.rate, options.unsprung_rate.value_or(options.rate));
}

Scenario makeScenario(const SimulationOptions& options) {
  validate(options);
  const ScenarioVehicle& vehicle = findVehicle(options);
  Scenario result;
  result.vehicle = vehicle.car;
  if (options.damping_to_mass) result.vehicle.damping = *options.damping_to_mass * vehicle.car.sprung_mass;
  if (options.stiffness_to_mass) result.vehicle.stiffness = *options.stiffness_to_mass * vehicle.car.sprung_mass;
  result.driven.mass = vehicle.car.sprung_mass;
  result.driven.struts = {strutOf(result.vehicle, options)};
  result.road = makeRoad(options, vehicle);
  if (options.scenario == "paper_outliers")
    result.zero_readings.assign(std::begin(kPaperLosses), std::end(kPaperLosses));
  return result;
}

}  // namespace suspension_health_monitor
