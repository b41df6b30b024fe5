#include "suspension_health_monitor/model/effect_settings.h"

#include <sstream>
#include <stdexcept>

#include "setting_groups.h"
#include "suspension_health_monitor/model/effect_catalogue.h"

namespace suspension_health_monitor {
namespace {

constexpr const char* kEffects = "effects";
constexpr const char* kReadings = "readings";
constexpr const char* kCoefficient = "coefficient";

}  // namespace

std::vector<ActiveEffect> takeEffects(OptionMap& values, const std::vector<ForceEffect>& catalogue) {
  std::vector<ActiveEffect> result;
  for (const auto& [name, settings] : takeGroups(values, kEffects)) {
    ActiveEffect active{findEffect(catalogue, name), 0.0, {}};
    const std::string group = std::string(kEffects) + '/' + name;
    std::vector<std::string> wanted{kCoefficient};
    for (const ShapeParameter& shape : active.effect.shapes) wanted.push_back(shape.name);
    const std::vector<double> numbers = takeNumbers(group, settings, wanted);
    active.coefficient = numbers.front();
    active.shapes.assign(numbers.begin() + 1, numbers.end());
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      if (!(active.shapes[i] > 0.0))
        throw std::invalid_argument(group + '/' + wanted[i + 1] + " = " + std::to_string(active.shapes[i]) + " [" +
                                    active.effect.shapes[i].unit + "], must be above 0");
    result.push_back(std::move(active));
  }
  return result;
}

std::vector<ActiveMeasurementEffect> takeReadings(OptionMap& values, const std::vector<MeasurementEffect>& catalogue) {
  std::vector<ActiveMeasurementEffect> result;
  for (const auto& [name, settings] : takeGroups(values, kReadings))
    result.push_back({findEffect(catalogue, name),
                      takeNumbers(std::string(kReadings) + '/' + name, settings, {kCoefficient}).front()});
  return result;
}

void setEffect(OptionMap& values, const std::string& assignment) {
  std::istringstream parts(assignment);
  std::string part, name;
  while (std::getline(parts, part, ',')) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == part.size())
      throw std::invalid_argument("--effect " + assignment + ", must be NAME=COEFFICIENT[,SHAPE=VALUE]...");
    const std::string key = name.empty() ? kCoefficient : part.substr(0, equals);
    if (name.empty()) name = part.substr(0, equals);
    values[std::string(kEffects) + '/' + name + '/' + key] = part.substr(equals + 1);
  }
  if (name.empty()) throw std::invalid_argument("--effect " + assignment + ", must be NAME=COEFFICIENT[,SHAPE=VALUE]...");
}

}  // namespace suspension_health_monitor
