#include "suspension_health_monitor/model/effect_settings.h"

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "suspension_health_monitor/model/effect_catalogue.h"

namespace suspension_health_monitor {
namespace {

constexpr const char* kPrefix = "effects/";
constexpr const char* kCoefficient = "coefficient";

std::string listShapes(const ForceEffect& effect) {
  std::string names = kCoefficient;
  for (const ShapeParameter& shape : effect.shapes) names += ", " + shape.name;
  return names;
}

double numberOf(const std::string& key, const OptionValue& value) {
  struct Number {
    std::optional<double> value;
  } number;
  OptionMap one{{"value", value}};
  static const std::array fields{
      OptionField<Number>{"value", "-", "a number in SI", &Number::value, -1e30, 1e30}};
  try {
    takeOptions(one, fields, number);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(key + ": " + error.what());
  }
  return *number.value;
}

ActiveEffect makeEffect(const std::string& name, const std::map<std::string, double>& numbers,
                        const std::vector<ForceEffect>& catalogue) {
  ActiveEffect active{findEffect(catalogue, name), 0.0, {}};
  const auto take = [&](const std::string& wanted) {
    const auto found = numbers.find(wanted);
    if (found == numbers.end())
      throw std::invalid_argument(kPrefix + name + "/" + wanted + " is missing; the effect needs " +
                                  listShapes(active.effect));
    return found->second;
  };
  active.coefficient = take(kCoefficient);
  for (const ShapeParameter& shape : active.effect.shapes) {
    active.shapes.push_back(take(shape.name));
    if (!(active.shapes.back() > 0.0))
      throw std::invalid_argument(kPrefix + name + "/" + shape.name + " [" + shape.unit + "], must be above 0");
  }
  for (const auto& [key, value] : numbers) {
    bool known = key == kCoefficient;
    for (const ShapeParameter& shape : active.effect.shapes) known = known || key == shape.name;
    if (!known)
      throw std::invalid_argument(kPrefix + name + "/" + key + " is unknown; the effect has " +
                                  listShapes(active.effect));
  }
  return active;
}

}  // namespace

std::vector<ActiveEffect> takeEffects(OptionMap& values, const std::vector<ForceEffect>& catalogue) {
  std::map<std::string, std::map<std::string, double>> effects;
  const std::string prefix = kPrefix;
  for (auto entry = values.lower_bound(prefix);
       entry != values.end() && entry->first.compare(0, prefix.size(), prefix) == 0; entry = values.erase(entry)) {
    const std::string& key = entry->first;
    const std::size_t slash = key.find('/', prefix.size());
    if (slash == std::string::npos)
      throw std::invalid_argument(key + " must be " + prefix + "NAME/" + kCoefficient + " or " + prefix +
                                  "NAME/SHAPE");
    effects[key.substr(prefix.size(), slash - prefix.size())][key.substr(slash + 1)] = numberOf(key, entry->second);
  }
  std::vector<ActiveEffect> result;
  for (const auto& [name, numbers] : effects) result.push_back(makeEffect(name, numbers, catalogue));
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
    values[kPrefix + name + '/' + key] = part.substr(equals + 1);
  }
  if (name.empty()) throw std::invalid_argument("--effect " + assignment + ", must be NAME=COEFFICIENT[,SHAPE=VALUE]...");
}

}  // namespace suspension_health_monitor
