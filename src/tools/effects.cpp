#include <cstdio>

#include "bag_options.h"
#include "command.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {

void effects(const Arguments& arguments) {
  boost::program_options::options_description description("options");
  addEffectsFile(description);
  const auto values = parse(arguments, "effects [--effects-file FILE]", description);
  if (!values) return;
  const EffectLibrary library = readEffects(*values);
  std::printf("| name | law | unit of c | shape | what a workshop would find |\n|---|---|---|---|---|\n");
  const auto row = [](const std::string& name, std::string law, const std::string& unit, const std::string& shapes,
                      const std::string& finding) {
    for (std::size_t bar = law.find('|'); bar != std::string::npos; bar = law.find('|', bar + 2)) law.insert(bar, "\\");
    std::printf("| `%s` | %s | %s | %s | %s |\n", name.c_str(), law.c_str(), unit.c_str(), shapes.c_str(),
                finding.c_str());
  };
  for (const ForceEffect& effect : library.forces) {
    std::vector<std::string> shapes;
    for (const ShapeParameter& shape : effect.shapes) shapes.push_back(shape.name + " [" + shape.unit + "]");
    row(effect.name, effect.law, effect.unit, join(shapes), effect.finding);
  }
  for (const MeasurementEffect& effect : library.readings) {
    std::vector<std::string> units;
    for (const MeasurementEffect::Coefficient& c : effect.coefficients)
      units.push_back(effect.coefficients.size() == 1 ? c.unit : c.name + " [" + c.unit + "]");
    row(effect.name, effect.law, join(units), "", effect.finding);
  }
}

}  // namespace suspension_health_monitor
