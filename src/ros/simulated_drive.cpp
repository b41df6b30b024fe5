#include "simulated_drive.h"

#include "drive_messages.h"
#include "vehicle_messages.h"

namespace suspension_health_monitor {
namespace {

SimulatedDrive driveOfVehicle(const VehicleSimulationOptions& options) {
  SimulatedDrive drive;
  drive.playing = options.playing;
  drive.duration = options.drive.duration;
  drive.rate = options.drive.rate;
  drive.topics = topicsOf(options);
  for (const VehicleStrut& strut : options.vehicle.struts) drive.awaited.push_back(unsprungTopic(strut));
  drive.begin = [options](Stamp start) { return std::make_unique<VehicleMessageSource>(options, start); };
  return drive;
}

SimulatedDrive driveOfStrut(const SimulatorOptions& options) {
  SimulatedDrive drive;
  drive.playing = options.playing;
  drive.duration = options.drive.duration;
  drive.rate = fasterRate(options.drive);
  drive.topics = topicsOf(options);
  drive.awaited = {kSprungTopic, kUnsprungTopic};
  drive.begin = [options](Stamp start) { return std::make_unique<DriveMessageSource>(options, start); };
  return drive;
}

}  // namespace

std::string takeVehicleModel(OptionMap& values) {
  const auto found = values.find("vehicle_model");
  if (found == values.end()) return "";
  OptionMap only{*found};
  values.erase(found);
  PublishingOptions options;
  takeOptions(only, kPublishingFields, options);
  return options.vehicle_model;
}

SimulatedDrive makeSimulatedDrive(OptionMap values) {
  const std::string model = takeVehicleModel(values);
  if (model.empty()) return driveOfStrut(SimulatorOptions::fromValues(std::move(values)));
  return driveOfVehicle(VehicleSimulationOptions::fromValues(model, std::move(values)));
}

}  // namespace suspension_health_monitor
