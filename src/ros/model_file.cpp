#include "model_file.h"

#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/model/user_effects.h"
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

EffectLibrary readEffectsFile(const std::string& path) {
  EffectLibrary library = builtInEffects();
  if (path.empty()) return library;
  for (ForceEffect& effect : takeFile(path, takeUserEffects)) library.forces.push_back(std::move(effect));
  return library;
}

}  // namespace suspension_health_monitor
