#pragma once

#include <array>
#include <sstream>
#include <stdexcept>
#include <string>

#include "model_file.h"
#include "suspension_health_monitor/internal/model/effect_settings.h"
#include "suspension_health_monitor/internal/option_table.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"

namespace suspension_health_monitor {

/// How a simulated drive is published, and what it may hide.
struct PublishingOptions {
  double gravity = 9.81;
  bool road_imu = false;
  double start_time = 0.0;
  double real_time_factor = 1.0;
  bool publish_clock = false;
  bool shutdown_at_end = false;
  std::string record;
  std::string record_topics = "/monitor/ls /monitor/la /monitor/comparison /monitor/health /simulator/truth";
  std::string effects_file;
  std::string hidden;
};

using PublishingField = OptionField<PublishingOptions>;
inline constexpr std::array kPublishingFields{
    PublishingField{"hidden", "hidden", "-",
                    "effects in the strut: NAME=COEFFICIENT[,SHAPE=VALUE]..., the next after ';'",
                    &PublishingOptions::hidden},
    PublishingField{"hidden", "effects_file", "-", "YAML file with laws of your own, to hide",
                    &PublishingOptions::effects_file},
    PublishingField{"sensors", "gravity", "m/s^2", "what both IMUs read on z at rest (REP 145)",
                    &PublishingOptions::gravity, -100.0, 100.0},
    PublishingField{"sensors", "road_imu", "-",
                    "a third IMU where the tyre touches the road, on road/imu; of vehicles on a tyre",
                    &PublishingOptions::road_imu},
    PublishingField{"playing", "start_time", "s",
                    "stamp at the start of the drive; live without publish_clock it is now",
                    &PublishingOptions::start_time, 0.0, 4e9},
    PublishingField{"playing", "real_time_factor", "-",
                    "drive seconds per wall second; 0: as fast as subscribers keep up",
                    &PublishingOptions::real_time_factor, 0.0, 1e6},
    PublishingField{"playing", "publish_clock", "-", "drive /clock, for nodes with use_sim_time",
                    &PublishingOptions::publish_clock},
    PublishingField{"playing", "record", "-", "bag to record the drive into, every message of it; empty: none",
                    &PublishingOptions::record},
    PublishingField{"playing", "record_topics", "-",
                    "what to record, with spaces; the drive begins once all are published",
                    &PublishingOptions::record_topics},
    PublishingField{"playing", "shutdown_at_end", "-", "shut the node or the nodelet manager down after the drive",
                    &PublishingOptions::shutdown_at_end},
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

  /// @return every option that fromValues() understands, by group.
  static std::vector<OptionDescription> describe() {
    return inGroups({"drive", "sensors", "hidden", "playing"}, describeOptions(kSimulationFields),
                    describeOptions(kPublishingFields));
  }
};

}  // namespace suspension_health_monitor
