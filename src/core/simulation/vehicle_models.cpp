#include <stdexcept>

#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/simulation/vehicle.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

struct NamedVehicle {
  std::string_view name;
  Vehicle vehicle;
};

// Plausible numbers of our own: every strut by itself 1.3 to 2.5 Hz with a damping ratio of 0.22 to 0.35, wheel hop 9
// to 14 Hz, front and rear different, the body IMU where there is room for it. No anti-roll bars: they are to be
// hidden.
const std::vector<NamedVehicle>& namedVehicles() {
  static const std::vector<NamedVehicle> vehicles{
      {"sedan",
       {1350.0,
        2100.0,
        480.0,
        "C",
        15.0,
        {{"front_left", 1.15, 0.75, 0.35, 1930.0, 26000.0, 41.0, 205000.0, 150.0},
         {"front_right", 1.15, -0.75, 0.35, 1930.0, 26000.0, 41.0, 205000.0, 150.0},
         {"rear_left", -1.45, 0.73, 0.3, 1790.0, 29000.0, 37.0, 205000.0, 150.0},
         {"rear_right", -1.45, -0.73, 0.3, 1790.0, 29000.0, 37.0, 205000.0, 150.0}},
        {},
        {},
        {0.2, -0.1, 0.05}}},
      {"ugv",
       {24.0,
        1.1,
        0.75,
        "D",
        4.0,
        {{"front_left", 0.34, 0.27, 0.04, 34.0, 780.0, 1.2, 9000.0, 6.0},
         {"front_right", 0.34, -0.27, 0.04, 34.0, 780.0, 1.2, 9000.0, 6.0},
         {"rear_left", -0.28, 0.27, 0.04, 52.0, 1180.0, 1.2, 9000.0, 6.0},
         {"rear_right", -0.28, -0.27, 0.04, 52.0, 1180.0, 1.2, 9000.0, 6.0}},
        {},
        {},
        {-0.06, 0.03, 0.08}}},
      {"truck",
       {6500.0,
        24000.0,
        6000.0,
        "C",
        16.0,
        {{"front_left", 2.1, 1.0, 0.1, 9300.0, 176000.0, 300.0, 850000.0, 600.0},
         {"front_right", 2.1, -1.0, 0.1, 9300.0, 176000.0, 300.0, 850000.0, 600.0},
         {"rear_left", -1.8, 0.93, -0.1, 12100.0, 329000.0, 550.0, 1700000.0, 1200.0},
         {"rear_right", -1.8, -0.93, -0.1, 12100.0, 329000.0, 550.0, 1700000.0, 1200.0}},
        {},
        {},
        {1.4, 0.3, 0.4}}},
      {"half_sedan",
       {675.0,
        800.0,
        0.0,
        "C",
        15.0,
        {{"front", 1.15, 0.0, 0.35, 1930.0, 26000.0, 41.0, 205000.0, 150.0},
         {"rear", -1.45, 0.0, 0.3, 1790.0, 29000.0, 37.0, 205000.0, 150.0}},
        {},
        {},
        {0.2, 0.0, 0.05}}},
  };
  return vehicles;
}

}  // namespace

std::string vehicleNames() {
  std::vector<std::string> names;
  for (const NamedVehicle& vehicle : namedVehicles()) names.emplace_back(vehicle.name);
  return join(names);
}

Vehicle namedVehicle(std::string_view name) {
  for (const NamedVehicle& named : namedVehicles())
    if (named.name == name) return named.vehicle;
  throw std::invalid_argument("vehicle model " + shortened(std::string(name)) + ", must be one of " + vehicleNames());
}

}  // namespace suspension_health_monitor
