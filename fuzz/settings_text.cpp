#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "entry_points.h"
#include "ros/shell_options.h"
#include "ros/yaml_settings.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"

namespace suspension_health_monitor {
namespace {

void readSettings(OptionMap values) { PipelineOptions::fromValues(std::move(values)); }

void readSimulation(OptionMap values) {
  SimulationOptions options;
  takeOptions(values, kSimulationFields, options);
  refuseUnknown(values, describeOptions(kSimulationFields));
}

/// What is read can be written, and what is written is read as the same.
void readModel(OptionMap values) {
  const EffectLibrary library = builtInEffects();
  const std::string written = toYaml(takeModel(values, library));
  refuseUnknown(values, {});
  OptionMap again = parseYaml(written, "written");
  if (toYaml(takeModel(again, library)) != written) throw std::logic_error("a written model is read differently");
}

void readLaws(OptionMap values) {
  const std::vector<ForceEffect> effects = takeUserEffects(values);
  refuseUnknown(values, {});
  for (const ForceEffect& effect : effects) {
    const ForceEffect copy = effect;
    const std::vector<double> shapes(effect.shapes.size(), 0.5);
    for (const StrutMotion& motion :
         {StrutMotion{}, StrutMotion{0.1, -1.0, 10.0, 0.2}, StrutMotion{-1e3, 1e9, 0.0, 1.0}}) {
      const double force = effect.force(motion, shapes.data()), same = copy.force(motion, shapes.data());
      if (std::isfinite(force) && force != same) throw std::logic_error("a copy of a law has another force");
      if (effect.memory_rate) effect.memory_rate(motion, shapes.data());
    }
  }
}

}  // namespace

std::string readSettingsText(const std::string& text) {
  std::string answers;
  for (void (*const read)(OptionMap) : {readSettings, readSimulation, readModel, readLaws}) {
    try {
      read(parseYaml(text, "text"));
      answers += "accepted\n";
    } catch (const std::invalid_argument& refusal) {
      answers += refusal.what() + std::string("\n");
    }
  }
  return answers;
}

}  // namespace suspension_health_monitor
