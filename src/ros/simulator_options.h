#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "model_file.h"
#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"

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

/// What is published of a simulated drive, and what it may hide.
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

  /// The same with the laws of effects_file, and the catalogue's.
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
    if (options.publishing.road_imu && !makeScenario(options.drive).vehicle.tyre_stiffness)
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

}  // namespace suspension_health_monitor
