#include "suspension_health_monitor/internal/model/model_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {
namespace {

/// Reads the plain block YAML that toYaml() writes: names by indentation, values as text.
OptionMap parse(const std::string& yaml) {
  OptionMap values;
  std::vector<std::string> path;
  std::size_t begin = 0;
  while (begin < yaml.size()) {
    const std::size_t end = yaml.find('\n', begin);
    std::string line = yaml.substr(begin, end - begin);
    begin = end + 1;
    line = line.substr(0, line.find("  #"));
    const std::size_t indent = line.find_first_not_of(' '), colon = line.find(':');
    path.resize(indent / 2);
    path.push_back(line.substr(indent, colon - indent));
    std::string name;
    for (const std::string& part : path) name += (name.empty() ? "" : "/") + part;
    if (colon + 1 < line.size()) values[name] = line.substr(colon + 2);
  }
  return values;
}

ActiveEffect active(const std::string& name, double coefficient, std::vector<double> shapes = {}) {
  return {findEffect(forceEffects(), name), coefficient, std::move(shapes)};
}

StrutModel exampleModel() {
  return {0.1 + 0.2,
          63.3,
          {active("bump_stop", 1.0 / 3.0, {0.02}), active("asymmetric_damping", -4e-12)},
          {{findEffect(measurementEffects(), "clock_offset"), {-0.0041}}}};
}

std::string refusal(OptionMap values) {
  try {
    takeModel(values, builtInEffects());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expectNamed(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

TEST(ModelSettings, YamlIsForPeopleAndHasUnits) {
  StrutModel model = exampleModel();
  model.damping_to_mass = 6.0;
  EXPECT_EQ(toYaml(model),
            "damping_to_mass: 6  # [1/s]\n"
            "stiffness_to_mass: 63.3  # [1/s^2]\n"
            "effects:\n"
            "  bump_stop:\n"
            "    coefficient: 0.3333333333333333  # [1/s^2]\n"
            "    g: 0.02  # [m]\n"
            "  asymmetric_damping:\n"
            "    coefficient: -4e-12  # [1/s]\n"
            "readings:\n"
            "  clock_offset:\n"
            "    coefficient: -0.0041  # [s]\n");
  EXPECT_EQ(toYaml({3.0, 13.8, {}, {}}), "damping_to_mass: 3  # [1/s]\nstiffness_to_mass: 13.8  # [1/s^2]\n");
}

TEST(ModelSettings, YamlAndBackKeepsEveryBit) {
  for (const double number : {0.1 + 0.2, 1.0 / 3.0, 5e-300, 1.7976931348623157e29, std::nextafter(1.0, 2.0)}) {
    StrutModel model = exampleModel();
    model.damping_to_mass = -std::min(number, 1e14);
    model.effects[0].coefficient = number;
    const double shape = std::clamp(number, 1e-9, 1e9);
    model.effects[0].shapes[0] = shape;
    model.reading[0].coefficients = {-number};
    OptionMap values = parse(toYaml(model));
    const StrutModel back = takeModel(values, builtInEffects());
    EXPECT_TRUE(values.empty());
    EXPECT_EQ(back.damping_to_mass, model.damping_to_mass);
    EXPECT_EQ(back.stiffness_to_mass, model.stiffness_to_mass);
    ASSERT_EQ(back.effects.size(), 2u);
    EXPECT_EQ(back.effects[0].effect.name, "asymmetric_damping");  // by name
    EXPECT_EQ(back.effects[0].coefficient, -4e-12);
    EXPECT_EQ(back.effects[1].effect.name, "bump_stop");
    EXPECT_EQ(back.effects[1].coefficient, number);
    EXPECT_EQ(back.effects[1].shapes, std::vector<double>{shape});
    EXPECT_TRUE(back.is_complete);
    ASSERT_EQ(back.reading.size(), 1u);
    EXPECT_EQ(back.reading[0].effect.name, "clock_offset");
    EXPECT_EQ(back.reading[0].coefficients, std::vector<double>{-number});
  }
}

TEST(ModelSettings, AModelThatLeavesMoreThanNoiseIsMarkedSo) {
  StrutModel model = exampleModel();
  model.is_complete = false;
  OptionMap values = parse(toYaml(model));
  EXPECT_FALSE(takeModel(values, builtInEffects()).is_complete);
}

TEST(ModelSettings, LeavesOtherSettings) {
  OptionMap values{{"damping_to_mass", 3}, {"stiffness_to_mass", std::string("13.8")}, {"rate", 100.0}};
  const StrutModel model = takeModel(values, builtInEffects());
  EXPECT_EQ(model.damping_to_mass, 3.0);
  EXPECT_EQ(model.stiffness_to_mass, 13.8);
  EXPECT_EQ(values.size(), 1u);
}

TEST(ModelSettings, MessagesNameTheMistakeAndWhatIsAllowed) {
  const OptionMap linear{{"damping_to_mass", 3.0}, {"stiffness_to_mass", 13.8}};
  const auto with = [&](const std::string& name, const OptionValue& value) {
    OptionMap values = linear;
    values[name] = value;
    return refusal(values);
  };
  EXPECT_EQ(refusal(linear), "accepted");
  expectNamed(refusal({{"damping_to_mass", 3.0}}), {"stiffness_to_mass", "missing"});
  expectNamed(refusal({{"stiffness_to_mass", 3.0}}), {"damping_to_mass", "missing"});
  expectNamed(with("stiffness_to_mass", 0.0), {"stiffness_to_mass = 0", "must be in"});
  expectNamed(with("damping_to_mass", std::nan("")), {"damping_to_mass = nan"});
  expectNamed(with("damping_to_mass", std::string("soft")), {"damping_to_mass", "soft"});
  expectNamed(with("effects/gremlin/coefficient", 1.0), {"gremlin", "bump_stop"});
  expectNamed(with("effects/bump_stop/coefficient", 1.0), {"effects/bump_stop/g", "missing"});
  expectNamed(with("readings/bump_stop/coefficient", 1.0), {"bump_stop", "clock_offset"});
  expectNamed(with("readings/clock_offset/c", 1.0), {"readings/clock_offset/c", "unknown", "coefficient"});
  expectNamed(with("readings/clock_offset/coefficient", std::string("late")), {"readings/clock_offset", "late"});
}

TEST(ModelSettings, RefusesMoreEffectsThanAStrutStateHolds) {
  OptionMap values{{"damping_to_mass", 3.0}, {"stiffness_to_mass", 13.8}};
  for (const ForceEffect& effect : forceEffects()) {
    values["effects/" + effect.name + "/coefficient"] = 1.0;
    for (const ShapeParameter& shape : effect.shapes) values["effects/" + effect.name + '/' + shape.name] = 2.0;
  }
  expectNamed(refusal(values), {"effects", "at most 8"});
}

}  // namespace
}  // namespace suspension_health_monitor
