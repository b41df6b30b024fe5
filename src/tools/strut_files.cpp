#include "strut_files.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "../ros/live_baseline.h"
#include "../ros/model_file.h"
#include "../ros/yaml_settings.h"
#include "bag_options.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/setting_groups.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

/// @return by name what the file has of the struts.
std::map<std::string, OptionMap> readStruts(const std::string& path, const AskedVehicle& vehicle) {
  OptionMap values = readYaml(path);
  return prefixed(path + ": ", [&] {
    std::map<std::string, OptionMap> struts = takeGroups(values, kStruts);
    if (struts.empty() && vehicle.only)
      struts[vehicle.names[*vehicle.only]] = std::move(values);
    else if (struts.empty())
      throw std::invalid_argument(
          "struts are missing, must be struts: {NAME: {...}}; the file of one strut needs --strut NAME");
    else if (!values.empty())
      throw std::invalid_argument(shortened(values.begin()->first) + " stands beside struts, must be of a strut");
    for (const auto& [name, settings] : struts)
      if (std::find(vehicle.names.begin(), vehicle.names.end(), name) == vehicle.names.end())
        throw std::invalid_argument("struts/" + shortened(name) + ", must be one of " + join(vehicle.names));
    if (vehicle.only && struts.count(vehicle.names[*vehicle.only]) == 0)
      throw std::invalid_argument("struts/" + vehicle.names[*vehicle.only] + " is missing, which --strut asks for");
    return struts;
  });
}

/// @param take  makes of a strut's settings what it is.
template <class Take>
auto readByStrut(const std::string& path, const AskedVehicle& vehicle, const Take& take) {
  std::vector<std::optional<decltype(take(std::declval<OptionMap&>()))>> taken(vehicle.names.size());
  std::map<std::string, OptionMap> struts = readStruts(path, vehicle);
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (const auto found = struts.find(vehicle.names[i]); found != struts.end())
      prefixed(path + ": " + vehicle.names[i] + ": ", [&] { taken[i] = take(found->second); });
  return taken;
}

}  // namespace

KnownModels readModels(const boost::program_options::variables_map& values, const AskedVehicle& vehicle,
                       const EffectLibrary& library) {
  if (values.count(kModel) == 0) return KnownModels(vehicle.names.size());
  return readByStrut(values[kModel].as<std::string>(), vehicle, [&](OptionMap& settings) {
    StrutModel model = takeModel(settings, library);
    refuseUnknown(settings, {});
    return model;
  });
}

std::vector<std::optional<Baseline>> readBaselines(const std::string& path, const AskedVehicle& vehicle) {
  return readByStrut(path, vehicle, takeBaseline);
}

std::string toYaml(const KnownModels& models, const AskedVehicle& vehicle) {
  if (vehicle.only) return toYaml(*models[*vehicle.only]);
  ModelsByStrut by_name;
  for (std::size_t i = 0; i < models.size(); ++i)
    if (models[i]) by_name.emplace(vehicle.names[i], *models[i]);
  return toYaml(by_name);
}

}  // namespace suspension_health_monitor
