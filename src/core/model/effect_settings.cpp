#include <sstream>
#include <stdexcept>

#include "find_by_name.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/setting_groups.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

constexpr const char* kEffects = "effects";
constexpr const char* kReadings = "readings";
constexpr const char* kCoefficient = "coefficient";

std::string orFaults(const std::vector<MeasurementEffect>& faults) {
  if (faults.empty()) return "";
  return "; or a fault of the reading (" + std::string(kReadings) + "/NAME/...): " + join(namesOf(faults));
}

}  // namespace

std::vector<ActiveEffect> takeEffects(OptionMap& values, const std::vector<ForceEffect>& catalogue,
                                      const std::vector<MeasurementEffect>& faults) {
  std::vector<ActiveEffect> result;
  for (const auto& [name, settings] : takeGroups(values, kEffects)) {
    ActiveEffect active{findByName(catalogue, name, orFaults(faults)), 0.0, {}};
    const std::string group = std::string(kEffects) + '/' + name;
    std::vector<std::string> wanted{kCoefficient};
    for (const ShapeParameter& shape : active.effect.shapes) wanted.push_back(shape.name);
    const std::vector<double> numbers = takeNumbers(group, settings, wanted);
    active.coefficient = numbers.front();
    active.shapes.assign(numbers.begin() + 1, numbers.end());
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      requireAllowed(group + '/' + wanted[i + 1], active.effect.shapes[i], active.shapes[i]);
    result.push_back(std::move(active));
  }
  return result;
}

std::vector<ActiveMeasurementEffect> takeReadings(OptionMap& values, const std::vector<MeasurementEffect>& catalogue) {
  std::vector<ActiveMeasurementEffect> result;
  for (const auto& [name, settings] : takeGroups(values, kReadings)) {
    const MeasurementEffect& effect = findEffect(catalogue, name);
    const std::string group = std::string(kReadings) + '/' + name;
    result.push_back({effect, takeNumbers(group, settings, namesOf(effect.coefficients))});
  }
  return result;
}

void setEffect(OptionMap& values, const std::string& assignment, const std::vector<MeasurementEffect>& faults) {
  const auto refuse = [&] {
    throw std::invalid_argument("--effect " + shortened(assignment) + ", must be NAME=COEFFICIENT[,SHAPE=VALUE]...");
  };
  std::istringstream parts(assignment);
  std::string part, group, first = kCoefficient;
  while (std::getline(parts, part, ',')) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == part.size()) refuse();
    const std::string name = part.substr(0, equals), value = part.substr(equals + 1);
    if (!group.empty()) {
      values[group + name] = value;
      continue;
    }
    group = std::string(kEffects) + '/' + name + '/';
    for (const MeasurementEffect& fault : faults) {
      if (fault.name != name) continue;
      group = std::string(kReadings) + '/' + name + '/';
      first = fault.coefficients.front().name;
      for (const MeasurementEffect::Coefficient& c : fault.coefficients) values[group + c.name] = 0.0;
    }
    values[group + first] = value;
  }
  if (group.empty()) refuse();
}

}  // namespace suspension_health_monitor
