#include "suspension_health_monitor/internal/simulation/scenario.h"

#include <algorithm>
#include <map>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/simulation/sensors.h"

namespace suspension_health_monitor {

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

// paper: section 4, non-pneumatic tyres, hence a rigid wheel.
// golden_car: the reference quarter car of the International Roughness Index (Sayers, "On the calculation of
//   International Roughness Index from longitudinal road profile", TRR 1501, 1995): beta/M = 6.0 1/s, K/M = 63.3 1/s^2,
//   K0/M = 653 1/s^2, m/M = 0.15; only ratios are given there, M = 250 kg is ours.
// rover, ugv: our own choice of a small slow rover (body 1.7 Hz) and of a softer, faster one (1.0 Hz) on bad ground,
//   with the golden car's ratio K0/K of about 10.
Vehicle quarterCarOf(const SimulationOptions& options) {
  // Mass, inertias, road and speed; of the strut name, place, damping, stiffness, the wheel's mass, the tyre's
  // stiffness.
  static const std::map<std::string, Vehicle> cars{
      {"paper", {50.0, 0.0, 0.0, "C", 5.0, {{"", 0.0, 0.0, 0.0, 150.0, 690.0, 5.0}}}},
      {"golden_car", {250.0, 0.0, 0.0, "C", 15.0, {{"", 0.0, 0.0, 0.0, 1500.0, 15825.0, 37.5, 163250.0}}}},
      {"rover", {10.0, 0.0, 0.0, "E", 2.0, {{"", 0.0, 0.0, 0.0, 50.0, 1200.0, 2.0, 12000.0}}}},
      {"ugv", {50.0, 0.0, 0.0, "D", 6.0, {{"", 0.0, 0.0, 0.0, 200.0, 2000.0, 7.5, 20000.0}}}},
  };
  constexpr double kPaperDampingLeft = 100.0 / 150.0;
  const bool is_on_iso_road = options.scenario == "iso_road";
  const std::string usual = is_on_iso_road ? "golden_car" : "paper";
  Vehicle car = cars.at(options.vehicle == "default" ? usual : options.vehicle);
  if (options.iso_class != "default") car.iso_class = options.iso_class;
  car.speed = options.speed.value_or(car.speed);
  VehicleStrut& strut = car.struts.front();
  if (options.damping_to_mass) strut.damping = *options.damping_to_mass * car.mass;
  if (options.stiffness_to_mass) strut.stiffness = *options.stiffness_to_mass * car.mass;
  strut.damping_end_fraction = options.damping_end_fraction.value_or(is_on_iso_road ? 1.0 : kPaperDampingLeft);
  strut.ramp_start = options.ramp_start;
  strut.ramp_end = options.ramp_end;
  if (options.scenario == "paper_saturation") {
    // The paper leaves its limit open. These stops are reached on its bumps only: 50 000 N/m on its 50 kg.
    strut.stop_gap = 0.09;
    strut.stop_stiffness_to_mass = 1000.0;
  }
  strut.hidden = options.hidden;
  return car;
}

Road roadOf(const SimulationOptions& options) {
  if (options.scenario == "iso_road") {
    const Vehicle car = quarterCarOf(options);
    return IsoRoad(car.iso_class.front(), car.speed, options.seed);
  }
  if (options.scenario == "paper_saturation") return [](double t) { return paperRoad(t) + paperBumps(t); };
  return paperRoad;
}

bool losesReadings(const SimulationOptions& options, double t) {
  return options.scenario == "paper_outliers" && ((t >= 25.0 && t <= 26.0) || (t >= 65.0 && t <= 66.0));
}

}  // namespace suspension_health_monitor
