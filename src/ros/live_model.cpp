#include "live_model.h"

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "model_file.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "whole_file.h"
#include "yaml_settings.h"

namespace suspension_health_monitor {
namespace {

/// The names of a text with commas.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> names;
  boost::split(names, text, boost::is_any_of(","));
  for (std::string& name : names) boost::trim_if(name, boost::is_any_of(" \t"));
  names.erase(std::remove(names.begin(), names.end(), ""), names.end());
  return names;
}

const ActiveEffect* find(const std::vector<ActiveEffect>& effects, const std::string& name) {
  const auto found = std::find_if(effects.begin(), effects.end(),
                                  [&](const ActiveEffect& active) { return active.effect.name == name; });
  return found == effects.end() ? nullptr : &*found;
}

std::vector<std::string> effectNames(const std::vector<ActiveEffect>& effects) {
  return mapped(effects, [](const ActiveEffect& active) { return active.effect.name; });
}

/// As the final fit has the effect, else as it was fitted alone.
const ActiveEffect* find(const Diagnosis& found, const std::string& name) {
  if (const ActiveEffect* active = found.final_fit ? find(found.final_fit->model.effects, name) : nullptr)
    return active;
  for (const RankedModel& ranked : found.ranking)
    if (const ActiveEffect* active = find(ranked.model.effects, name)) return active;
  return nullptr;
}

double middle(const std::string& name, const ShapeParameter& shape, const LiveModel::Scale& scale) {
  const double plain = std::sqrt(shape.min * shape.max);
  if (shape.scale == ShapeScale::kNone) return plain;
  const std::optional<MotionScale> motion = scale();
  if (!motion)
    throw std::invalid_argument(name + " [" + shape.unit +
                                "] is not known yet: give it, give a model_file that has it, call ~diagnose, or drive "
                                "on until the monitor can tell how far the strut moves");
  return plain * motion->unit(shape.scale);
}

}  // namespace

LiveModel::LiveModel(const ShellOptions& options, const std::string& strut)
    : model_file_(options.model_file), strut_(strut) {
  prefixed("effects_file = ", [&] { library_ = readEffectsFile(options.effects_file); });
  if (!model_file_.empty() && std::filesystem::exists(model_file_))
    prefixed("model_file = ", [&] { loaded_ = load(); });
  if (loaded_) effects_ = loaded_->effects;
  std::vector<std::string> names = effectNames(effects_);
  for (const std::string& name : split(options.effects))
    if (find(effects_, name) == nullptr) names.push_back(name);
  prefixed("effects = \"" + options.effects + "\": ",
           [&] { effects_ = choose(names, {}, [] { return std::nullopt; }); });
}

std::optional<StrutModel> LiveModel::load() const {
  if (strut_.empty()) return readModelFile(model_file_, library_);
  const ModelsByStrut all = readModelsFile(model_file_, library_);
  const auto found = all.find(strut_);
  return found != all.end() ? std::optional<StrutModel>(found->second) : std::nullopt;
}

const ActiveEffect* LiveModel::known(const std::string& name) const {
  const ActiveEffect* active = diagnosis_ ? find(*diagnosis_, name) : nullptr;
  if (active == nullptr && loaded_) active = find(loaded_->effects, name);
  return active != nullptr ? active : find(effects_, name);
}

ActiveEffect LiveModel::make(const std::string& name, Shapes& given, const Scale& scale) const {
  ActiveEffect made{findEffect(library_.forces, name), 0.0, {}};
  const ActiveEffect* known_effect = known(name);
  for (std::size_t i = 0; i < made.effect.shapes.size(); ++i) {
    const ShapeParameter& shape = made.effect.shapes[i];
    const std::string full = name + '/' + shape.name;
    if (const auto found = given.find(full); found != given.end()) {
      requireAllowed(full, shape, found->second);
      made.shapes.push_back(found->second);
      given.erase(found);
    } else {
      made.shapes.push_back(known_effect != nullptr ? known_effect->shapes[i] : middle(full, shape, scale));
    }
  }
  // A coefficient is a good start only for the shapes that it was found with.
  if (known_effect != nullptr && made.shapes == known_effect->shapes) made.coefficient = known_effect->coefficient;
  return made;
}

std::vector<ActiveEffect> LiveModel::choose(const std::vector<std::string>& names, Shapes given,
                                            const Scale& scale) const {
  if (names.size() > kMostEffects)
    throw std::invalid_argument(std::to_string(names.size()) + " effects, must be at most " +
                                std::to_string(kMostEffects));
  std::vector<ActiveEffect> chosen;
  for (const std::string& name : names) {
    if (find(chosen, name) != nullptr)
      throw std::invalid_argument("effect " + name + " is named twice, must be named once");
    chosen.push_back(make(name, given, scale));
  }
  if (given.empty()) return chosen;
  std::vector<std::string> shapes;
  for (const ActiveEffect& active : chosen)
    for (const ShapeParameter& shape : active.effect.shapes) shapes.push_back(active.effect.name + '/' + shape.name);
  throw std::invalid_argument("shape " + given.begin()->first + ", must be " +
                              (shapes.empty() ? "left out: these effects have none" : "one of " + join(shapes, ", ")));
}

std::optional<LinearStrut> LiveModel::strutFor(const std::vector<ActiveEffect>& effects) const {
  const auto belongs = [&](const StrutModel& model) {
    return std::equal(effects.begin(), effects.end(), model.effects.begin(), model.effects.end(),
                      [](const ActiveEffect& a, const ActiveEffect& b) {
                        return a.effect.name == b.effect.name && a.coefficient == b.coefficient && a.shapes == b.shapes;
                      });
  };
  for (const StrutModel* model :
       {diagnosis_ && *diagnosis_ ? &diagnosis_->model() : nullptr, loaded_ ? &*loaded_ : nullptr})
    if (model != nullptr && belongs(*model)) return model->linearPart();
  return std::nullopt;
}

std::string LiveModel::describe() const {
  return effects_.empty() ? "the linear strut" : "the linear strut with " + join(effectNames(effects_));
}

std::vector<std::string> LiveModel::remarks() const {
  std::vector<std::string> all;
  if (!model_file_.empty() && !loaded_)
    all.push_back("model_file " + model_file_ +
                  (std::filesystem::exists(model_file_) ? " has no model of " + strut_
                                                        : " is not there yet" + inWhichFolder(model_file_)) +
                  ": starting with " + describe());
  if (!isComplete())
    all.push_back(model_file_ + ": the model leaves more than noise, so health does not judge by nominal values");
  if (loaded_)
    for (const ActiveMeasurementEffect& reading : loaded_->reading)
      all.push_back(model_file_ + ": " + reading.effect.name +
                    " is a fault of a sensor, which the live model cannot have: mend the sensor");
  return all;
}

std::vector<std::string> LiveModel::missing() const {
  std::vector<std::string> names;
  if (!diagnosis_) return names;
  for (const std::string& name : diagnosis_->selected)
    if (find(effects_, name) == nullptr) names.push_back(name);
  return names;
}

void LiveModel::save(StrutModel model) const {
  if (model_file_.empty())
    throw std::runtime_error(
        "no file to write to: start with the parameter model_file, as model_file:=FILE of the launch files");
  if (loaded_) {
    model.reading = loaded_->reading;
    model.is_complete = loaded_->is_complete;
  }
  if (diagnosis_ && *diagnosis_ && effectNames(diagnosis_->model().effects) == effectNames(model.effects))
    model.is_complete = diagnosis_->model().is_complete;
  if (strut_.empty()) return TextFile(model_file_).commit(toYaml(model));
  ModelsByStrut all;
  if (std::filesystem::exists(model_file_)) all = readModelsFile(model_file_, library_);
  all.insert_or_assign(strut_, model);
  TextFile(model_file_).commit(toYaml(all));
}

std::optional<StrutModel> modelOf(const SuspensionMonitor* monitor) {
  if (monitor == nullptr || !monitor->modelEstimate().valid()) return std::nullopt;
  const StrutEstimate& estimate = monitor->modelEstimate();
  return StrutModel{estimate.damping_to_mass, estimate.stiffness_to_mass, monitor->effects(), {}};
}

}  // namespace suspension_health_monitor
