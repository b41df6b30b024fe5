#include "model_file.h"

#include <regex>
#include <stdexcept>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "yaml_settings.h"

namespace suspension_health_monitor {
namespace {

/// Calls take(settings) with what the file holds; what it leaves is refused.
template <class Take>
auto takeFile(const std::string& path, const Take& take) {
  OptionMap values = readYaml(path);
  return prefixed(path + ": ", [&] {
    auto taken = take(values);
    refuseUnknown(values, {});
    return taken;
  });
}

}  // namespace

StrutModel readModelFile(const std::string& path, const EffectLibrary& library) {
  return takeFile(path, [&](OptionMap& values) { return takeModel(values, library); });
}

ModelsByStrut readModelsFile(const std::string& path, const EffectLibrary& library) {
  return takeFile(path, [&](OptionMap& values) {
    ModelsByStrut models;
    for (auto& [name, settings] : takeGroups(values, kStruts))
      prefixed(name + ": ", [&, &strut = name, &its = settings] { models.emplace(strut, toModel(its, library)); });
    if (models.empty()) throw std::invalid_argument("struts are missing, must be struts: {NAME: {...}}");
    return models;
  });
}

std::string belowStrut(const std::string& name, const std::string& settings) {
  return "  " + name + ":\n" + std::regex_replace(settings, std::regex("[^\n]+"), "    $&");
}

std::string toYaml(const ModelsByStrut& models) {
  std::string text = std::string(kStruts) + ":\n";
  for (const auto& [name, model] : models) text += belowStrut(name, toYaml(model));
  return text;
}

EffectLibrary readEffectsFile(const std::string& path) {
  EffectLibrary library = builtInEffects();
  if (path.empty()) return library;
  for (ForceEffect& effect : takeFile(path, takeUserEffects)) library.forces.push_back(std::move(effect));
  return library;
}

}  // namespace suspension_health_monitor
