#pragma once

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "../ros/shell_options.h"
#include "imu_bags.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

namespace suspension_health_monitor {

/// The struts that a command is asked about: those of --vehicle, or the one of the topics, which is alone and has no
/// name.
struct AskedVehicle {
  VehicleLayout layout;
  std::string file;                 ///< of --vehicle; empty: a strut alone
  std::vector<std::string> names;   ///< of the struts
  std::vector<std::size_t> asked;   ///< their places
  std::optional<std::size_t> only;  ///< place of the strut of --strut, or of the one that is alone

  bool isStrutAlone() const { return file.empty(); }

  /// @return what is written before a strut; nothing where it is alone.
  std::string prefix(std::size_t strut, const char* after, const char* before = "") const {
    return isStrutAlone() ? "" : before + names[strut] + after;
  }

  /// @return where a strut's results are among those of the command.
  nlohmann::json& resultsOf(std::size_t strut, nlohmann::json& whole) const {
    return isStrutAlone() ? whole : whole["struts"][names[strut]];
  }
};

/// @throws std::invalid_argument  as readVehicleFile(), for topics beside a vehicle or twice the same, and for a strut
/// that is none of it.
AskedVehicle readVehicle(const boost::program_options::variables_map& values);

/// Finds the sensors of a vehicle in bags.
/// @param bags  whose topics become those of VehicleStreams::sensors.
/// @param layout  whose struts with a frame get their position, by the static transforms of the bags.
/// @throws InputError, TooLittleError  as readTopics().
/// @throws std::invalid_argument  if a frame has no static transform.
void findSensors(ImuBags& bags, const ShellOptions& options, VehicleLayout& layout);

}  // namespace suspension_health_monitor
