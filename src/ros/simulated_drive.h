#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "playing_options.h"
#include "simulated_messages.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/option_table.h"

namespace suspension_health_monitor {

/// What the simulator's nodelet has to know of a drive: of one strut, or of a whole vehicle.
struct SimulatedDrive {
  PlayingOptions playing;
  double duration = 0.0;             ///< [s]
  double rate = 0.0;                 ///< of the fastest sensor [Hz]
  MessagesOnTopics topics;           ///< all that it has, each with an empty message of its type
  std::vector<std::string> awaited;  ///< topics that somebody must listen to before the drive begins
  std::function<std::unique_ptr<DriveSource>(Stamp start)> begin;
};

/// @param values  those of `options simulator`, or with a vehicle_model those of `options vehicle`.
/// @throws std::invalid_argument  naming an unknown name, or a value that is wrong and what is allowed.
SimulatedDrive makeSimulatedDrive(OptionMap values);

/// Takes the option `vehicle_model` out of `values`.
/// @return empty: a drive of one strut.
std::string takeVehicleModel(OptionMap& values);

}  // namespace suspension_health_monitor
