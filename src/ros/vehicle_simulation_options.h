#pragma once

#include <string>
#include <vector>

#include "simulator_options.h"
#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/simulation/vehicle_simulator.h"

namespace suspension_health_monitor {

/// What is published of a vehicle's simulated drive, and what it may hide.
struct VehiclePublishingOptions {
  std::string sprung_imus = "all", effects_file;
};

inline constexpr OptionField<VehiclePublishingOptions> kVehiclePublishingFields[] = {
    {"sensors", "sprung_imus", "-",
     "struts with an IMU of their own on the body: all, none (the body's IMU alone), or names",
     &VehiclePublishingOptions::sprung_imus},
    {"hidden", "effects_file", "-", "YAML file with laws of your own, for struts/NAME/effects",
     &VehiclePublishingOptions::effects_file},
};

/// A vehicle to simulate, its drive, and what is published of it.
struct VehicleSimulationOptions {
  std::string model;  ///< as it was given
  Vehicle vehicle;
  VehicleDriveOptions drive;
  VehiclePublishingOptions publishing;
  PlayingOptions playing;
  std::vector<bool> has_sprung_imu;  ///< by vehicle.struts

  /// @param model  a name that namedVehicle() knows, or a YAML file with settings of a vehicle (takeVehicle()).
  /// @param values  change it.
  /// @throws std::invalid_argument  naming an unknown name, or a value that is wrong and what is allowed.
  static VehicleSimulationOptions fromValues(const std::string& model, OptionMap values);

  /// @return every option, by group.
  static std::vector<OptionDescription> describe();
};

/// Names of the topics, without a slash in front.
inline std::string sprungTopic(const VehicleStrut& strut) { return strut.name + "/sprung/imu"; }
inline std::string unsprungTopic(const VehicleStrut& strut) { return strut.name + "/unsprung/imu"; }
inline std::string wrenchTopic(const KnownForce& force) { return force.name + "/wrench"; }
inline constexpr const char* kBodyImuTopic = "imu/data";

}  // namespace suspension_health_monitor
