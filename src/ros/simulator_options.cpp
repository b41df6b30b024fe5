#include "simulator_options.h"

#include <boost/tokenizer.hpp>
#include <filesystem>
#include <stdexcept>

#include "suspension_health_monitor/internal/base/text.h"
#include "yaml_settings.h"

namespace suspension_health_monitor {
namespace {

constexpr const char* kOfTheModel = "the model's";

Vehicle vehicleOf(const std::string& model, const EffectLibrary& library) {
  try {
    return namedVehicle(model);
  } catch (const std::invalid_argument& error) {
    const bool is_file = model.find_first_of("./") != std::string::npos || std::filesystem::exists(model);
    if (!is_file) throw std::invalid_argument(std::string(error.what()) + ", or a YAML file");
  }
  OptionMap values = readYaml(model);
  return prefixed(model + ": ", [&] {
    Vehicle vehicle = takeVehicle(values, library);
    refuseUnknown(values, describeOptions(kVehicleFields));
    return vehicle;
  });
}

std::vector<bool> havingSprungImu(const std::string& names, const Vehicle& vehicle) {
  if (names == "all" || names == "none") return std::vector<bool>(vehicle.struts.size(), names == "all");
  std::vector<bool> has(vehicle.struts.size(), false);
  using Separator = boost::char_separator<char>;
  prefixed("sprung_imus: ", [&] {
    for (const std::string& name : boost::tokenizer<Separator>(names, Separator(", ")))
      has[vehicle.strutNamed(name)] = true;
  });
  return has;
}

}  // namespace

VehicleSimulationOptions VehicleSimulationOptions::fromValues(const std::string& model, OptionMap values) {
  VehicleSimulationOptions options;
  options.model = model;
  takeOptions(values, kVehiclePublishingFields, options.publishing);
  takeOptions(values, kVehicleDriveFields, options.drive);
  takeOptions(values, kPlayingFields, options.playing);
  const EffectLibrary library = readEffectsFile(options.publishing.effects_file);
  options.vehicle = vehicleOf(model, library);
  changeVehicle(values, library, options.vehicle);
  refuseUnknown(values, describe());
  validate(options.vehicle);
  validate(options.drive);
  options.has_sprung_imu = havingSprungImu(options.publishing.sprung_imus, options.vehicle);
  return options;
}

std::vector<OptionDescription> VehicleSimulationOptions::describe() {
  std::vector<OptionDescription> vehicle = describeOptions(kVehicleFields);
  std::vector<OptionDescription> struts = describeOptions(kVehicleStrutFields);
  for (OptionDescription& option : vehicle) option.default_value = kOfTheModel;
  for (std::size_t i = 0; i < kRequiredStrutFields; ++i) struts[i].default_value = kOfTheModel;
  std::vector<OptionDescription> all = describeOptions(kVehicleDriveFields);
  for (const auto& more : {describeOptions(kVehiclePublishingFields), vehicle, describeOptions(kPlayingFields), struts,
                           describeOptions(kKnownForceFields), describeOptions(kVehicleImuFields)})
    all.insert(all.end(), more.begin(), more.end());
  return inGroups({"drive", "vehicle", "sensors", "hidden", "playing"}, std::move(all), {});
}

}  // namespace suspension_health_monitor
