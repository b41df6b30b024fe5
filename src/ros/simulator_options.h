#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "model_file.h"
#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"
#include "suspension_health_monitor/internal/simulation/vehicle_simulator.h"

namespace suspension_health_monitor {

/// When a simulated drive is published, and how it is recorded.
struct PlayingOptions {
  double start_time = 0.0, real_time_factor = 1.0;
  bool publish_clock = false, shutdown_at_end = false;
  std::string record;
  std::string record_topics =
      "/monitor/estimate /monitor/ls /monitor/la /monitor/comparison /monitor/health /simulator/truth";
};

inline constexpr OptionField<PlayingOptions> kPlayingFields[] = {
    {"playing", "start_time", "s", "stamp at the start of the drive; live without publish_clock it is now",
     &PlayingOptions::start_time, 0.0, 4e9},
    {"playing", "real_time_factor", "-", "drive seconds per wall second; 0: as fast as subscribers keep up",
     &PlayingOptions::real_time_factor, 0.0, 1e6},
    {"playing", "publish_clock", "-", "drive /clock, for nodes with use_sim_time", &PlayingOptions::publish_clock},
    {"playing", "record", "-", "bag to record the drive into, every message of it; empty: none",
     &PlayingOptions::record},
    {"playing", "record_topics", "-", "what to record, with spaces; the drive begins once all are published",
     &PlayingOptions::record_topics},
    {"playing", "shutdown_at_end", "-", "shut the node or the nodelet manager down after the drive",
     &PlayingOptions::shutdown_at_end},
};

/// What is published of the drive of one strut, and what it may hide.
struct PublishingOptions {
  double gravity = 9.81;
  bool road_imu = false;
  std::string effects_file, hidden;
  std::string vehicle_model;  ///< for takeVehicleModel(): of a drive of one strut empty
};

inline constexpr OptionField<PublishingOptions> kPublishingFields[] = {
    {"drive", "vehicle_model", "-",
     "a whole vehicle: sedan, ugv, truck, half_sedan or a YAML file; its options are those of "
     "`suspension_bag options vehicle` instead of these",
     &PublishingOptions::vehicle_model},
    {"hidden", "hidden", "-", "effects in the strut: NAME=COEFFICIENT[,SHAPE=VALUE]..., the next after ';'",
     &PublishingOptions::hidden},
    {"hidden", "effects_file", "-", "YAML file with laws of your own, to hide", &PublishingOptions::effects_file},
    {"sensors", "gravity", "m/s^2", "what both IMUs read on z at rest (REP 145)", &PublishingOptions::gravity, -100.0,
     100.0},
    {"sensors", "road_imu", "-", "a third IMU where the tyre touches the road, on road/imu; of vehicles on a tyre",
     &PublishingOptions::road_imu},
};

/// The same of a vehicle.
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

/// What config/simulator.yaml can set.
struct SimulatorOptions {
  SimulationOptions drive;
  PublishingOptions publishing;
  PlayingOptions playing;

  /// @throws std::invalid_argument  naming an unknown name, or a value that is wrong and what is allowed.
  static SimulatorOptions fromValues(OptionMap values) {
    SimulatorOptions options;
    OptionMap of_publishing = values;
    takeOptions(of_publishing, kPublishingFields, options.publishing);
    return fromValues(std::move(values), readEffectsFile(options.publishing.effects_file));
  }

  /// The same with the laws of effects_file, and the catalogue's. Stands here for the Python module of arrays, which
  /// has nothing of ROS.
  static SimulatorOptions fromValues(OptionMap values, const EffectLibrary& library) {
    SimulatorOptions options;
    takeOptions(values, kPublishingFields, options.publishing);
    takeOptions(values, kPlayingFields, options.playing);
    std::istringstream hidden(options.publishing.hidden);
    for (std::string effect; std::getline(hidden, effect, ';');) {
      effect.erase(0, effect.find_first_not_of(' '));
      if (!effect.empty()) setEffect(values, effect, library.readings);
    }
    options.drive.hidden = takeEffects(values, library.forces, library.readings);
    options.drive.hidden_faults = takeReadings(values, library.readings);
    takeOptions(values, kSimulationFields, options.drive);
    refuseUnknown(values, describe());
    validate(options.drive);
    if (options.publishing.road_imu && quarterCarOf(options.drive).struts.front().isRigid())
      throw std::invalid_argument("road_imu = true, must be false for vehicle = " + options.drive.vehicle +
                                  " in scenario = " + options.drive.scenario + ": its wheel is rigid");
    return options;
  }

  /// @return every option that fromValues() understands, by group.
  static std::vector<OptionDescription> describe() {
    return inGroups({"drive", "sensors", "hidden", "playing"}, describeOptions(kSimulationFields),
                    inGroups({"drive", "sensors", "hidden", "playing"}, describeOptions(kPublishingFields),
                             describeOptions(kPlayingFields)));
  }
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
