#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/model/strut_integrator.h"

namespace suspension_health_monitor {
namespace {

/// Settings of one effect called "own", from its own settings.
OptionMap own(const OptionMap& settings) {
  OptionMap values;
  for (const auto& [key, value] : settings) values["effects/own/" + key] = value;
  return values;
}

OptionMap withForce(const std::string& force) { return own({{"force", force}, {"unit", std::string("m/s^2")}}); }

OptionMap withShape(OptionMap values, const std::string& name, const std::string& scale = "travel") {
  const std::string shape = "effects/own/shapes/" + name + '/';
  values[shape + "unit"] = std::string("m");
  values[shape + "scale"] = scale;
  values[shape + "min"] = 0.2;
  values[shape + "max"] = std::string("3e0");
  return values;
}

ForceEffect take(OptionMap values) {
  const std::vector<ForceEffect> effects = takeUserEffects(values);
  EXPECT_TRUE(values.empty());
  return effects.at(0);
}

double valueOf(const std::string& force, const StrutMotion& motion = {}) {
  return take(withForce(force)).force(motion, nullptr);
}

std::string refusal(OptionMap values) {
  try {
    takeUserEffects(values);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expectNamed(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

TEST(UserEffects, LawIsEvaluatedInTravelRateTimeMemoryAndShapes) {
  OptionMap values = withShape(withShape(withForce(""), "gap"), "v2");
  values["effects/own/force"] = std::string("d + 10 * v2 + 100 * v + 1000 * t + 1e4 * s + 1e5 * gap");
  values["effects/own/memory_rate"] = std::string("(d - s) / gap - v2 * t");
  const ForceEffect effect = take(values);
  const double shapes[] = {0.5, 0.25};  // by name: gap, v2
  const StrutMotion motion{2.0, 3.0, 4.0, 5.0};
  EXPECT_DOUBLE_EQ(effect.force(motion, shapes), 2.0 + 2.5 + 300.0 + 4000.0 + 5e4 + 5e4);
  EXPECT_DOUBLE_EQ(effect.memory_rate(motion, shapes), -3.0 / 0.5 - 0.25 * 4.0);
}

TEST(UserEffects, DescribesItselfAsTheCatalogueDoes) {
  OptionMap values = withShape(withForce("d * abs(d / x)"), "x");
  values["effects/own/finding"] = std::string("second spring engages");
  const ForceEffect effect = take(values);
  EXPECT_EQ(effect.name, "own");
  EXPECT_EQ(effect.law, "c (d * abs(d / x))");
  EXPECT_EQ(effect.unit, "m/s^2");
  EXPECT_EQ(effect.finding, "second spring engages");
  EXPECT_EQ(effect.advice, "");
  EXPECT_FALSE(effect.memory_rate);
  ASSERT_EQ(effect.shapes.size(), 1u);
  EXPECT_EQ(effect.shapes[0].name, "x");
  EXPECT_EQ(effect.shapes[0].unit, "m");
  EXPECT_EQ(effect.shapes[0].scale, ShapeScale::kTravel);
  EXPECT_EQ(effect.shapes[0].min, 0.2);
  EXPECT_EQ(effect.shapes[0].max, 3.0);
}

TEST(UserEffects, ScalesOfShapesAreThoseOfTheCatalogue) {
  const std::vector<std::pair<std::string, ShapeScale>> scales{{"none", ShapeScale::kNone},
                                                               {"travel", ShapeScale::kTravel},
                                                               {"travel_rate", ShapeScale::kTravelRate},
                                                               {"time", ShapeScale::kTime},
                                                               {"frequency", ShapeScale::kFrequency}};
  for (const auto& [name, scale] : scales)
    EXPECT_EQ(take(withShape(withForce("d * x"), "x", name)).shapes[0].scale, scale) << name;
}

TEST(UserEffects, FunctionsAndOperatorsMeanWhatTheyMeanOnPaper) {
  const StrutMotion motion{-0.5, 2.0, 9.0, 0.0};
  EXPECT_EQ(valueOf("min(3, d, v)", motion), -0.5);
  EXPECT_EQ(valueOf("max(0, d)", motion), 0.0);
  EXPECT_EQ(valueOf("abs(d)", motion), 0.5);
  EXPECT_EQ(valueOf("sign(d) + 10 * sign(v) + 100 * sign(0)", motion), 9.0);
  EXPECT_EQ(valueOf("tanh(v)", motion), std::tanh(2.0));
  EXPECT_EQ(valueOf("exp(d)", motion), std::exp(-0.5));
  EXPECT_EQ(valueOf("sqrt(t)", motion), 3.0);
  EXPECT_EQ(valueOf("log(exp(v)) - ln(exp(v))", motion), 0.0);
  EXPECT_NEAR(valueOf("log10(100)", motion), 2.0, 1e-15);
  EXPECT_EQ(valueOf("d > 0 ? 7 : v < 0 ? 8 : 9", motion), 9.0);
  EXPECT_EQ(valueOf("d < 0 && v >= 2 || t == 1", motion), 1.0);
  EXPECT_EQ(valueOf("d != d", motion), 0.0);
  EXPECT_EQ(valueOf("-v^2", motion), -4.0);
  EXPECT_EQ(valueOf("2^3^2", motion), 512.0);
  EXPECT_DOUBLE_EQ(valueOf("cos(_pi) + 1e-3", motion), -0.999);
}

TEST(UserEffects, MemoryFollowsItsClosedForm) {
  // s' = (d - s)/tau: a strut held by an enormous spring under a constant wheel acceleration keeps its travel d, and
  // s = d (1 - exp(-t/tau)).
  OptionMap values = withShape(withForce("d - s"), "tau", "time");
  values["effects/own/memory_rate"] = std::string("(d - s) / tau");
  StrutModel model{200.0, 1e4, {{take(values), 0.0, {0.5}}}, {}};
  StrutState state;
  state.travel = 0.02;
  constexpr double step = 1e-3, wheel = 0.02 * 1e4;
  const WheelStep constant{wheel * step * step / 8, wheel * step / 2, wheel * step * step / 2, wheel * step};
  for (int k = 0; k < 1000; ++k) integrateStrut(model, k * step, step, constant, state);
  EXPECT_NEAR(state.travel, 0.02, 1e-7);  // the stages of a step see wheel and body at slightly different times
  EXPECT_NEAR(state.memory[0], 0.02 * (1.0 - std::exp(-1.0 / 0.5)), 1e-7);
}

TEST(UserEffects, WrongExpressionIsRefusedWithEffectExpressionAndPosition) {
  const auto refused = [](const std::string& force) { return refusal(withShape(withForce(force), "gap")); };
  expectNamed(refused("max(0, d - gapp)^2"), {"effects/own/force = \"max(0, d - gapp)^2\"", "\"gapp\"",
                                              "at character 12", "names: d, gap, t, v,", "tanh"});
  expectNamed(refused("d *^ 3"), {"operator \"^\"", "at character 4"});
  expectNamed(refused("(d + v"), {"parenthesis", "at the end"});
  expectNamed(refused("d) + v"), {"parenthesis", "at character 2"});
  expectNamed(refused("d + "), {"end of expression", "at the end"});
  expectNamed(refused("2 d"), {"\"d\"", "at character 3"});
  expectNamed(refused("abs(d, v)"), {"\"abs\"", "Too many", "at character 9"});
  expectNamed(refused("|d|"), {"\"|d|\"", "at character 1"});
  expectNamed(refused("d > 0 ? d"), {"else", "at the end"});
  expectNamed(refused("c * d"), {"\"c\"", "at character 1"});
  expectNamed(refused("d = 3"), {"\"=\"", "at character 3", "=="});
  expectNamed(refused("d, v"), {"several results"});
  expectNamed(refused(""), {"effects/own/force", "empty"});
  OptionMap memory = withForce("s");
  memory["effects/own/memory_rate"] = std::string("d - v -");
  expectNamed(refusal(memory), {"effects/own/memory_rate = \"d - v -\"", "at the end"});
}

TEST(UserEffects, MemoryIsKnownOnlyWhereItHasARate) {
  expectNamed(refusal(withForce("d - s")), {"\"s\"", "at character 5"});
}

TEST(UserEffects, LawThatIsNotFiniteIsRefusedWithTheMotion) {
  expectNamed(refusal(withForce("v / abs(v)")), {"effects/own/force = \"v / abs(v)\"", "not finite", "v = 0,"});
  expectNamed(refusal(withForce("sqrt(d)")), {"not finite", "d = -0.001"});
  expectNamed(refusal(withForce("ln(abs(d))")), {"not finite", "d = 0,"});
  expectNamed(refusal(withForce("1 / t")), {"not finite", "t = 0,"});
  OptionMap memory = withForce("s");
  memory["effects/own/memory_rate"] = std::string("d / s");
  expectNamed(refusal(memory), {"effects/own/memory_rate", "not finite", "s = 0"});
}

TEST(UserEffects, NamesThatExistAlreadyAreRefused) {
  const OptionMap law{{"force", std::string("d")}, {"unit", std::string("1/s^2")}};
  for (const char* name : {"bump_stop", "clock_offset"}) {
    OptionMap values;
    for (const auto& [key, value] : law) values[std::string("effects/") + name + '/' + key] = value;
    expectNamed(refusal(values), {name, "built-in"});
  }
  for (const char* name : {"d", "v", "t", "s", "c", "coefficient", "tanh", "max", "_pi"})
    expectNamed(refusal(withShape(withForce("d"), name)), {std::string("effects/own/shapes/") + name});
}

TEST(UserEffects, SettingsAreNamedWhereTheyAreWrong) {
  OptionMap values = withForce("d");
  values["effects/own/memory_rte"] = std::string("d");
  expectNamed(refusal(values), {"effects/own", "unknown option memory_rte", "memory_rate"});
  expectNamed(refusal(own({{"unit", std::string("m")}})), {"effects/own/force", "missing"});
  expectNamed(refusal(own({{"force", std::string("d")}})), {"effects/own/unit", "missing"});
  expectNamed(refusal({{"effects/own", std::string("d")}}), {"effects/own", "effects/NAME/SETTING"});
  expectNamed(refusal(withShape(withForce("d"), "x", "length")), {"effects/own/shapes/x", "length", "travel_rate"});
  values = withShape(withForce("d"), "x");
  values["effects/own/shapes/x/min"] = 4.0;
  expectNamed(refusal(values), {"effects/own/shapes/x", "min must be below max"});
  values["effects/own/shapes/x/min"] = -1.0;
  expectNamed(refusal(values), {"effects/own/shapes/x", "min = -1"});
  values.erase("effects/own/shapes/x/min");
  expectNamed(refusal(values), {"effects/own/shapes/x/min", "missing"});
  values = withForce("d");
  for (const char* name : {"w", "x", "y", "z"}) values = withShape(values, name);
  expectNamed(refusal(values), {"effects/own", "4 shapes", "at most 3"});
  values = withForce("d");
  values["effects/own/unit"] = std::string("m\ncoefficient: 3");
  expectNamed(refusal(values), {"effects/own", "one line"});
  expectNamed(refusal({{"effects/my law/force", std::string("d")}}), {"effects/my law", "letters"});
}

TEST(UserEffects, CopiesOnThreadsGiveTheNumbersOfOneThread) {
  OptionMap values = withShape(withForce("max(0, d - gap)^2 + v * abs(v) * exp(-abs(d / gap)) + s"), "gap");
  values["effects/own/memory_rate"] = std::string("tanh(v / gap) - s");
  const ForceEffect original = take(values);
  constexpr int kMotions = 20000;
  const auto sum = [](const ForceEffect& effect, double gap) {
    double total = 0.0;
    for (int k = 0; k < kMotions; ++k) {
      const StrutMotion motion{std::sin(0.1 * k), std::cos(0.1 * k), 0.01 * k, std::sin(0.3 * k)};
      total += effect.force(motion, &gap) + effect.memory_rate(motion, &gap);
    }
    return total;
  };
  constexpr std::size_t kThreads = 4;
  std::vector<double> alone, together(kThreads);
  for (std::size_t i = 0; i < kThreads; ++i) alone.push_back(sum(original, 0.1 * (1.0 + static_cast<double>(i))));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i)
    threads.emplace_back([&, i] {
      const ForceEffect copy = original;  // copied while others evaluate their copies
      together[i] = sum(copy, 0.1 * (1.0 + static_cast<double>(i)));
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(alone, together);
}

TEST(UserEffects, CopyOutlivesTheOriginalAndAssignmentKeepsVariablesApart) {
  ForceEffect kept;
  {
    const ForceEffect original = take(withForce("d + 10 * v"));
    kept = original;
    EXPECT_EQ(original.force({7.0, 7.0, 0.0, 0.0}, nullptr), 77.0);
  }
  const ForceEffect moved = std::move(kept);
  EXPECT_EQ(moved.force({1.0, 2.0, 0.0, 0.0}, nullptr), 21.0);
}

TEST(UserEffects, LawOfTheCatalogueWrittenAsAnExpressionIsTheSameLaw) {
  OptionMap values = withShape(withForce("v / sqrt(1 + (v / knee)^2)"), "knee", "travel_rate");
  const ForceEffect effect = take(values);
  const ForceEffect& built_in = findEffect(forceEffects(), "digressive_damping");
  for (const double rate : {-2.0, -0.1, 0.0, 0.3, 5.0}) {
    const double knee = 0.4;
    EXPECT_DOUBLE_EQ(effect.force({0.0, rate, 0.0, 0.0}, &knee), built_in.force({0.0, rate, 0.0, 0.0}, &knee));
  }
}

}  // namespace
}  // namespace suspension_health_monitor
