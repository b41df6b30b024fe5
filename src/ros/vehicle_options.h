#pragma once

#include <string>
#include <vector>

#include "shell_options.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

namespace suspension_health_monitor {

/// Reads which sensors a vehicle has, and where (vehicle/vehicle_layout.h).
/// @throws std::invalid_argument  naming the file and what is wrong in it.
VehicleLayout readVehicleFile(const std::string& path);

/// What VehicleNodelet is set to: `vehicle`, the file that says which sensors the vehicle has, or `vehicle/...`, what
/// such a file says; the settings of config/monitor.yaml for all struts; and `struts/NAME/SETTING` where a strut
/// differs. A `model_file` for all has the models of all, as `suspension_bag diagnose --vehicle -o` writes it.
struct VehicleOptions {
  VehicleLayout layout;
  PipelineOptions common;
  std::vector<PipelineOptions> struts;  ///< by VehicleLayout::struts
  std::vector<std::string> model_of;    ///< by strut LiveModel's `strut`: empty if its model_file is its own

  /// @throws std::invalid_argument  naming file, strut, option, value and what is allowed.
  static VehicleOptions fromValues(OptionMap values);

  /// The same with the sensors that were read already; `values` are without `vehicle`.
  static VehicleOptions fromValues(VehicleLayout layout, OptionMap values);

  /// One strut alone.
  static VehicleOptions ofOneStrut(const PipelineOptions& options);

  bool isOneStrut() const { return layout.struts.front().name.empty(); }  ///< alone, not of a vehicle file

  /// @return "struts/NAME: ", for messages about the settings of a strut; empty of one alone.
  std::string prefix(std::size_t strut) const {
    return isOneStrut() ? "" : "struts/" + layout.struts[strut].name + ": ";
  }
  std::vector<std::string> strutNames() const { return namesOf(layout.struts); }
  std::vector<std::string> forceNames() const { return namesOf(layout.known_forces); }
  std::vector<std::string> temperatureTopics() const;  ///< by strut; empty: it has no thermometer
};

}  // namespace suspension_health_monitor
