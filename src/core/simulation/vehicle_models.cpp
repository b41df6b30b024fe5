#include <stdexcept>

#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/simulation/vehicle.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

using NamedVehicle = std::pair<std::string, Vehicle>;

Vehicle onStruts(Vehicle body, const std::vector<VehicleStrut>& struts) {
  body.struts = struts;
  return body;
}

/// @param front, rear  the struts on the left; those on the right are alike.
Vehicle onFourWheels(const Vehicle& body, const VehicleStrut& front, const VehicleStrut& rear) {
  std::vector<VehicleStrut> struts;
  for (const VehicleStrut& left : {front, rear})
    for (const double side : {1.0, -1.0}) {
      struts.push_back(left);
      struts.back().name += side > 0.0 ? "_left" : "_right";
      struts.back().y *= side;
    }
  return onStruts(body, struts);
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

std::string vehicleNames() {
  std::vector<std::string> names;
  for (const NamedVehicle& named : namedVehicles()) names.push_back(named.first);
  return join(names);
}

Vehicle namedVehicle(std::string_view name) {
  for (const NamedVehicle& named : namedVehicles())
    if (named.first == name) return named.second;
  throw std::invalid_argument("vehicle model " + shortened(std::string(name)) + ", must be one of " + vehicleNames());
}

}  // namespace suspension_health_monitor
