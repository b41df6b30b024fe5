#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "model_file.h"
#include "playing_options.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/option_table.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"

namespace suspension_health_monitor {

/// What is published of a simulated drive, and what it may hide.
struct PublishingOptions {
  double gravity = 9.81;
  bool road_imu = false;
  std::string effects_file;
  std::string hidden;
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
