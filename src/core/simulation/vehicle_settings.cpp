#include "suspension_health_monitor/internal/simulation/vehicle_settings.h"

#include <algorithm>
#include <stdexcept>

#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/prefixed.h"
#include "suspension_health_monitor/internal/setting_groups.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
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

void changeBar(const std::string& name, const std::string& other, double stiffness, Vehicle& vehicle) {
  AntiRollBar bar{};
  prefixed("anti_roll_bars: ", [&] { bar = {vehicle.strutNamed(name), vehicle.strutNamed(other), stiffness}; });
  const auto same = [&](const AntiRollBar& there) {
    return std::minmax(there.first, there.second) == std::minmax(bar.first, bar.second);
  };
  std::vector<AntiRollBar>& bars = vehicle.anti_roll_bars;
  bars.erase(std::remove_if(bars.begin(), bars.end(), same), bars.end());
  bars.push_back(bar);
}

void changeBars(OptionMap& values, Vehicle& vehicle) {
  for (const auto& [name, others] : takeGroups(values, "anti_roll_bars"))
    for (const auto& [other, stiffness] : others)
      changeBar(name, other, toNumber("anti_roll_bars/" + name + '/' + other, stiffness, 0.0, kStiffest), vehicle);
}

void changeKnownForces(OptionMap& values, Vehicle& vehicle) {
  for (auto& [name, settings] : takeGroups(values, "known_forces")) {
    requireName("known_forces/" + shortened(name), name);
    std::vector<KnownForce>& forces = vehicle.known_forces;
    const auto same = [&, &name = name](const KnownForce& force) { return force.name == name; };
    auto force = std::find_if(forces.begin(), forces.end(), same);
    if (force == forces.end()) {
      force = forces.emplace(forces.end());
      force->name = name;
    }
    takeAll("known_forces/" + name, settings, kKnownForceFields, *force);
  }
}

void changeImu(OptionMap& values, Vehicle& vehicle) {
  takeAll("body_imu", takePrefixed(values, "body_imu"), kVehicleImuFields, vehicle.body_imu);
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
  changeImu(values, vehicle);
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
    vehicle.struts.emplace_back();
    vehicle.struts.back().name = name;
  }
  changeVehicle(values, library, vehicle);
  validate(vehicle);
  return vehicle;
}

}  // namespace suspension_health_monitor
