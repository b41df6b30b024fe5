#include "simulated_drive.h"

#include <algorithm>

#include "conversions.h"

namespace suspension_health_monitor {

std_msgs::Header headerAt(Stamp stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = std::max(toRosTime(std::max(stamp, Stamp::zero())), ros::TIME_MIN);
  header.frame_id = frame;
  return header;
}

std::string takeVehicleModel(OptionMap& values) {
  OptionMap only;
  only.insert(values.extract("vehicle_model"));
  PublishingOptions options;
  takeOptions(only, kPublishingFields, options);
  return options.vehicle_model;
}

SimulatedDrive makeSimulatedDrive(OptionMap values) {
  const std::string model = takeVehicleModel(values);
  if (model.empty()) return driveOf(SimulatorOptions::fromValues(std::move(values)));
  return driveOf(VehicleSimulationOptions::fromValues(model, std::move(values)));
}

}  // namespace suspension_health_monitor
