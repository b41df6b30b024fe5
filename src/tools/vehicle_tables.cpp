#include <cmath>
#include <cstdio>

#include "results.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

json couplingJson(const std::vector<std::vector<double>>& ratios, const std::vector<std::string>& names) {
  json result = json::object();
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < names.size(); ++j)
      if (i != j) result[names[i]][names[j]] = ratios[i][j];
  return result;
}

json barsJson(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  json bars = json::array();
  for (const AntiRollBarFound& bar : coupling.bars)
    bars.push_back(
        {{"struts", {names[bar.first], names[bar.second]}},
         {"stiffness_to_mass",
          {{names[bar.first], bar.first_stiffness_to_mass}, {names[bar.second], bar.second_stiffness_to_mass}}}});
  return bars;
}

json forcesJson(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  json forces = json::object();
  for (const KnownForceCoefficients& force : coupling.forces)
    for (std::size_t i = 0; i < names.size(); ++i) {
      forces[force.name]["coefficients"][names[i]] = force.values[i];
      forces[force.name]["stddevs"][names[i]] = force.stddevs[i];
    }
  return forces;
}

void printForces(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  for (const KnownForceCoefficients& force : coupling.forces) {
    std::printf("one unit of %s accelerates the tops by [m/s^2]:", force.name.c_str());
    for (std::size_t i = 0; i < names.size(); ++i)
      std::printf("%s %s %.4g +- %.2g", i > 0 ? "," : "", names[i].c_str(), force.values[i], force.stddevs[i]);
    std::printf("\n");
  }
}

}  // namespace

void printCoupling(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  printForces(coupling, names);
  if (names.size() < 2) return;
  std::printf("how much of what a strut does to its own top reaches the others:\n%16s", "moved by");
  for (const std::string& name : names) std::printf("  %14s", name.c_str());
  std::printf("\n");
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::printf("%16s", names[i].c_str());
    for (std::size_t j = 0; j < names.size(); ++j)
      if (i == j)
        std::printf("  %14s", "1");
      else
        std::printf("  %6.3f +-%6.3f", coupling.ratios[i][j], coupling.stddevs[i][j]);
    std::printf("\n");
  }
  if (!std::isnan(coupling.model_error))
    std::printf("a rigid body on linear struts leaves %.2g %% of it unexplained\n", 100.0 * coupling.model_error);
  for (const AntiRollBarFound& bar : coupling.bars)
    std::printf("anti-roll bar between %s and %s: stiffness/mass %.4g and %.4g 1/s^2\n", names[bar.first].c_str(),
                names[bar.second].c_str(), bar.first_stiffness_to_mass, bar.second_stiffness_to_mass);
}

json wholeJson(const AskedVehicle& vehicle, const VehicleCoupling& coupling, const TopicGaps& gaps) {
  json whole{{"silent", gaps.toJson()}};
  if (vehicle.isStrutAlone()) return whole;
  whole["struts"] = json::object();
  whole["coupling"] = couplingJson(coupling.ratios, vehicle.names);
  whole["coupling_stddevs"] = couplingJson(coupling.stddevs, vehicle.names);
  whole["anti_roll_bars"] = barsJson(coupling, vehicle.names);
  whole["known_forces"] = forcesJson(coupling, vehicle.names);
  whole["model_error"] = coupling.model_error;
  return whole;
}

void printBody(const BodyInertiaResult& found) {
  if (!found.body) {
    std::printf("%s\n", describe(found.doubt).c_str());
    return;
  }
  const BodyInertia& body = *found.body;
  std::printf(
      "M/Iyy %.4g +- %.2g 1/m^2, M/Ixx %.4g +- %.2g 1/m^2, centre of gravity %.3g +- %.2g m ahead and %.3g +- %.2g m "
      "to the left of where positions count from\n",
      body.mass_to_pitch_inertia.value, body.mass_to_pitch_inertia.stddev, body.mass_to_roll_inertia.value,
      body.mass_to_roll_inertia.stddev, body.x.value, body.x.stddev, body.y.value, body.y.stddev);
}

json toJson(const BodyInertiaResult& found) {
  if (!found.body) return {{"reason", describe(found.doubt)}};
  const BodyInertia& body = *found.body;
  return {{"mass_to_pitch_inertia", body.mass_to_pitch_inertia.value},
          {"mass_to_pitch_inertia_stddev", body.mass_to_pitch_inertia.stddev},
          {"mass_to_roll_inertia", body.mass_to_roll_inertia.value},
          {"mass_to_roll_inertia_stddev", body.mass_to_roll_inertia.stddev},
          {"centre_of_gravity", {body.x.value, body.y.value}},
          {"centre_of_gravity_stddev", {body.x.stddev, body.y.stddev}}};
}

}  // namespace suspension_health_monitor
