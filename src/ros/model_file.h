#pragma once

#include <map>
#include <string>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// @return the model that settings are, all of them.
/// @throws std::invalid_argument  as takeModel(), also for a setting that is none of a model.
inline StrutModel toModel(OptionMap settings, const EffectLibrary& library) {
  StrutModel model = takeModel(settings, library);
  refuseUnknown(settings, {});
  return model;
}

/// Reads a model as `suspension_bag diagnose -o` writes it (model/model_settings.h).
/// @param library  what the model may be made of.
/// @throws std::invalid_argument  naming the file and what is wrong in it.
StrutModel readModelFile(const std::string& path, const EffectLibrary& library);

/// Below which a file has something of every strut, `struts: {NAME: {...}}`.
inline constexpr const char* kStruts = "struts";

/// @param settings  text of YAML.
/// @return the text of a strut's settings, to stand below kStruts.
std::string belowStrut(const std::string& name, const std::string& settings);

/// The models of a vehicle's struts, by name.
using ModelsByStrut = std::map<std::string, StrutModel>;

/// Reads `struts: {NAME: {a model as above}}`, as `suspension_bag diagnose --vehicle -o` writes it.
/// @throws std::invalid_argument  likewise.
ModelsByStrut readModelsFile(const std::string& path, const EffectLibrary& library);

/// @return the text of the file that readModelsFile() takes.
std::string toYaml(const ModelsByStrut& models);

/// Reads a user's own laws (model/user_effects.h).
/// @param path  empty: there are none.
/// @return the catalogue and these laws.
/// @throws std::invalid_argument  naming the file and what is wrong in it.
EffectLibrary readEffectsFile(const std::string& path);

}  // namespace suspension_health_monitor
