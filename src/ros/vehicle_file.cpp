#include "vehicle_file.h"

#include "yaml_settings.h"

namespace suspension_health_monitor {

VehicleLayout readVehicleFile(const std::string& path) {
  OptionMap values = readYaml(path);
  return prefixed(path + ": ", [&] { return takeVehicle(values); });
}

}  // namespace suspension_health_monitor
