#pragma once

#include <array>
#include <sstream>
#include <stdexcept>
#include <string>

#include "model_file.h"
#include "suspension_health_monitor/model/effect_settings.h"
#include "suspension_health_monitor/option_table.h"
#include "suspension_health_monitor/simulation/scenario.h"

namespace suspension_health_monitor {

/// How a simulated drive is published, and what it may hide.
struct PublishingOptions {
  double gravity = 9.81;
  bool road_imu = false;
  double start_time = 0.0;
  double real_time_factor = 1.0;
  bool publish_clock = false;
  bool wait_for_subscribers = true;
  double start_delay = 0.0;
  bool shutdown_at_end = false;
  std::string effects_file;
  std::string hidden;
};

using PublishingField = OptionField<PublishingOptions>;
inline constexpr std::array kPublishingFields{
    PublishingField{"gravity", "m/s^2", "what both IMUs read on z at rest (REP 145)", &PublishingOptions::gravity,
                    -100.0, 100.0},
    PublishingField{"road_imu", "-", "a third IMU where the tyre touches the road, on road/imu; of vehicles on a tyre",
                    &PublishingOptions::road_imu},
    PublishingField{"start_time", "s", "stamp at the start of the drive; live without publish_clock it is now",
                    &PublishingOptions::start_time, 0.0, 4e9},
    PublishingField{"real_time_factor", "-", "drive seconds per wall second; 0: as fast as subscribers keep up",
                    &PublishingOptions::real_time_factor, 0.0, 1e6},
    PublishingField{"publish_clock", "-", "drive /clock, for nodes with use_sim_time",
                    &PublishingOptions::publish_clock},
    PublishingField{"wait_for_subscribers", "-", "start when both IMU topics have a subscriber",
                    &PublishingOptions::wait_for_subscribers},
    PublishingField{"start_delay", "s", "wall time between that and the first message, for recorders to connect",
                    &PublishingOptions::start_delay, 0.0, 3600.0},
    PublishingField{"shutdown_at_end", "-", "shut the node or the nodelet manager down after the drive",
                    &PublishingOptions::shutdown_at_end},
    PublishingField{"effects_file", "-", "YAML file with laws of your own, to hide as effects/NAME/...",
                    &PublishingOptions::effects_file},
    PublishingField{"hidden", "-", "the same in one text: NAME=COEFFICIENT[,SHAPE=VALUE]..., the next after ';'",
                    &PublishingOptions::hidden},
};

/// What config/simulator.yaml can set.
struct SimulatorOptions {
  SimulationOptions drive;
  PublishingOptions publishing;

  /// @throws std::invalid_argument  naming an unknown name, or a value that is wrong and what is allowed.
  static SimulatorOptions fromValues(OptionMap values) {
    SimulatorOptions options;
    takeOptions(values, kPublishingFields, options.publishing);
    const EffectLibrary library = readEffectsFile(options.publishing.effects_file);
    setEffects(values, options.publishing.hidden, library.readings);
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

  /// Turns the option `hidden` into settings.
  static void setEffects(OptionMap& values, const std::string& hidden, const std::vector<MeasurementEffect>& faults) {
    std::istringstream parts(hidden);
    std::string part;
    while (std::getline(parts, part, ';')) {
      part.erase(0, part.find_first_not_of(' '));
      if (!part.empty()) setEffect(values, part, faults);
    }
  }

  /// @return every option that fromValues() understands.
  static std::vector<OptionDescription> describe() {
    std::vector<OptionDescription> all = describeOptions(kSimulationFields);
    for (OptionDescription& option : describeOptions(kPublishingFields)) all.push_back(std::move(option));
    return all;
  }
};

}  // namespace suspension_health_monitor
