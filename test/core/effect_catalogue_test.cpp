#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {
namespace {

constexpr double kNoMemory = std::numeric_limits<double>::quiet_NaN();

// A force and a memory rate worked by hand. What a law must not depend on is not 0 in the motion.
struct WorkedValue {
  std::string name;
  std::vector<double> shapes;
  StrutMotion motion;  // d, v, t, s
  double force;
  Memory memory_rate = kNoMemory;
};

const std::vector<WorkedValue>& workedValues() {
  static const std::vector<WorkedValue> values{
      {"progressive_spring", {3.0}, {0.2, -0.7, 5.0, 0.6}, 0.008},
      {"progressive_spring", {3.0}, {-0.2, 0.7, 5.0, 0.6}, -0.008},
      {"progressive_spring", {2.0}, {-0.5, 0.7, 5.0, 0.6}, -0.25},
      {"asymmetric_spring", {}, {-0.3, 0.7, 5.0, 0.6}, 0.3},
      {"asymmetric_spring", {}, {0.1, -0.7, 5.0, 0.6}, 0.1},
      {"bump_stop", {0.02}, {0.05, -0.7, 5.0, 0.6}, 0.03},
      {"bump_stop", {0.02}, {0.01, 0.7, 5.0, 0.6}, 0.0},
      {"bump_stop", {0.02}, {-0.05, 0.7, 5.0, 0.6}, 0.0},
      {"rebound_stop", {0.02}, {-0.05, 0.7, 5.0, 0.6}, -0.03},
      {"rebound_stop", {0.02}, {-0.01, -0.7, 5.0, 0.6}, 0.0},
      {"rebound_stop", {0.02}, {0.05, 0.7, 5.0, 0.6}, 0.0},
      {"backlash", {0.02}, {0.05, -0.7, 5.0, 0.6}, -0.01},
      {"backlash", {0.02}, {-0.05, 0.7, 5.0, 0.6}, 0.01},
      {"backlash", {0.02}, {0.006, 0.7, 5.0, 0.6}, -0.006},
      {"backlash", {0.02}, {-0.006, 0.7, 5.0, 0.6}, 0.006},
      {"damper_backlash", {0.02, 0.5}, {0.05, -0.7, 5.0, 0.02}, 0.02, 0.04},
      {"damper_backlash", {0.02, 0.5}, {-0.05, 0.7, 5.0, -0.01}, -0.03, -0.06},
      {"damper_backlash", {0.02, 0.5}, {-0.05, 0.7, 5.0, -0.045}, 0.0, 0.0},
      {"coulomb_friction", {0.1}, {-0.3, 0.1, 5.0, 0.6}, 0.76159415595576},
      {"coulomb_friction", {0.1}, {0.3, -0.1, 5.0, 0.6}, -0.76159415595576},
      {"coulomb_friction", {0.1}, {-0.3, 10.0, 5.0, 0.6}, 1.0},
      {"quadratic_damping", {}, {0.3, -2.0, 5.0, 0.6}, -4.0},
      {"quadratic_damping", {}, {-0.3, 0.5, 5.0, 0.6}, 0.25},
      {"asymmetric_damping", {}, {0.3, -2.0, 5.0, 0.6}, 2.0},
      {"asymmetric_damping", {}, {-0.3, 0.5, 5.0, 0.6}, 0.5},
      {"digressive_damping", {0.3}, {-0.2, 0.4, 5.0, 0.6}, 0.24},   // 0.4 / (5/3)
      {"digressive_damping", {0.4}, {0.2, -0.3, 5.0, 0.6}, -0.24},  // -0.3 / (5/4)
      {"position_dependent_damping", {}, {-0.1, 2.0, 5.0, 0.6}, 0.02},
      {"position_dependent_damping", {}, {0.2, -3.0, 5.0, 0.6}, -0.12},
      {"hysteresis", {0.02}, {-0.3, 0.4, 5.0, 0.5}, 0.5, 10.0},         // (0.4 - 0.2) / 0.02
      {"hysteresis", {0.02}, {0.3, -0.4, 5.0, 0.5}, 0.5, -30.0},        // (-0.4 - 0.2) / 0.02
      {"hysteresis", {0.02}, {0.3, -0.4, 5.0, -1.0}, -1.0, 0.0},        // friction fully built up
      {"bouc_wen", {0.02, 0.05}, {-0.3, 0.4, 5.0, 0.01}, 0.01, 0.28},   // 0.4 - 0.2 + 0.08
      {"bouc_wen", {0.02, 0.05}, {0.3, -0.4, 5.0, 0.01}, 0.01, -0.68},  // -0.4 - 0.2 - 0.08
      {"bouc_wen", {0.02, 0.05}, {0.3, 0.4, 5.0, -0.01}, -0.01, 0.68},  // 0.4 + 0.2 + 0.08
      {"body_drag", {2.0}, {0.3, -0.4, 5.0, 0.6, 1.5}, -0.6, 1.2},      // 1.5 - 0.6 / 2
      {"body_drag", {2.0}, {-0.3, 0.4, 5.0, -0.2, -1.0}, 0.2, -0.9},
      // w = 2, 2 zeta w = 1: the pull is s' + 4 s.
      {"load_on_spring", {1.0 / M_PI, 0.25}, {0.3, -0.4, 5.0, {0.5, -0.7}, 1.5}, 1.3, {-0.7, -2.8}},
      {"load_on_spring", {1.0 / M_PI, 0.25}, {-0.3, 0.4, 5.0, {-0.5, 0.2}, -1.0}, -1.8, {0.2, 2.8}},
      {"load_on_spring", {1.0 / M_PI, 0.5}, {-0.3, 0.4, 5.0, {0.0, 0.2}, 0.0}, 0.4, {0.2, -0.4}},
      {"warming", {20.0, 0.1}, {0.3, -0.4, 5.0, 0.1}, 0.04, 0.0025},  // (0.16 - 0.01 - 0.1) / 20
      {"warming", {20.0, 0.1}, {-0.3, 0.4, 5.0, 0.1, 1.5}, -0.04, 0.0025},
      {"warming", {50.0, 0.2}, {0.3, 0.0, 5.0, -0.1}, 0.0, 0.0012},
      {"viscoelastic_mount", {0.5}, {0.05, -0.7, 5.0, 0.02}, 0.03, 0.06},
      {"viscoelastic_mount", {0.5}, {-0.01, 0.7, 5.0, 0.02}, -0.03, -0.06},
      {"damping_drift", {}, {0.2, -0.3, 10.0, 0.6}, -3.0},
      {"damping_drift", {}, {-0.2, 0.3, 4.0, 0.6}, 1.2},
      {"stiffness_drift", {}, {-0.02, 0.3, 10.0, 0.6}, -0.2},
      {"stiffness_drift", {}, {0.03, -0.3, 4.0, 0.6}, 0.12},
  };
  return values;
}

TEST(EffectCatalogue, ForcesAndMemoryRatesAreAsWorkedByHand) {
  for (const WorkedValue& value : workedValues()) {
    const ForceEffect& effect = findEffect(forceEffects(), value.name);
    ASSERT_EQ(effect.shapes.size(), value.shapes.size()) << value.name;
    EXPECT_NEAR(effect.force(value.motion, value.shapes.data()), value.force, 1e-12)
        << value.name << " at d = " << value.motion.travel << ", v = " << value.motion.travel_rate;
    ASSERT_EQ(static_cast<bool>(effect.memory_rate), !std::isnan(value.memory_rate)) << value.name;
    if (!effect.memory_rate) continue;
    const Memory rate = effect.memory_rate(value.motion, value.shapes.data());
    EXPECT_NEAR(rate.s, value.memory_rate.s, 1e-12) << value.name;
    EXPECT_NEAR(rate.second, value.memory_rate.second, 1e-12) << value.name;
  }
}

TEST(EffectCatalogue, EveryEffectHasWorkedValues) {
  std::set<std::string> worked, known;
  for (const WorkedValue& value : workedValues()) worked.insert(value.name);
  for (const ForceEffect& effect : forceEffects()) known.insert(effect.name);
  EXPECT_EQ(worked, known);
}

TEST(EffectCatalogue, NamesAreUniqueAndTextsFilled) {
  std::set<std::string> names;
  const auto check = [&](const auto& effect) {
    EXPECT_TRUE(names.insert(effect.name).second) << effect.name;
    EXPECT_FALSE(effect.name.empty());
    EXPECT_NE(effect.law.find_first_of("cy"), std::string::npos) << effect.name;
    EXPECT_FALSE(effect.finding.empty()) << effect.name;
  };
  for (const ForceEffect& effect : forceEffects()) {
    check(effect);
    EXPECT_FALSE(effect.unit.empty()) << effect.name;
  }
  for (const MeasurementEffect& effect : measurementEffects()) {
    check(effect);
    EXPECT_FALSE(effect.coefficients.empty()) << effect.name;
    for (const MeasurementEffect::Coefficient& coefficient : effect.coefficients) {
      EXPECT_FALSE(coefficient.unit.empty()) << effect.name;
      if (effect.coefficients.size() == 1)
        EXPECT_EQ(coefficient.name, "coefficient") << effect.name;
      else
        EXPECT_NE(effect.law.find(coefficient.name), std::string::npos) << effect.name;
    }
  }
}

TEST(EffectCatalogue, ShapesHaveNamesUnitsAndPositiveRangesAndStandInTheLaw) {
  for (const ForceEffect& effect : forceEffects())
    for (const ShapeParameter& shape : effect.shapes) {
      EXPECT_NE(effect.law.find(shape.name), std::string::npos) << effect.name;
      EXPECT_GT(shape.min, 0.0) << effect.name;
      EXPECT_LT(shape.min, shape.max) << effect.name;
      const char* units[] = {"-", "m", "m/s", "s", "Hz"};  // in the order of ShapeScale
      EXPECT_EQ(shape.unit, units[static_cast<int>(shape.scale)]) << effect.name;
    }
}

TEST(EffectCatalogue, ForcesAreFiniteFromRestToViolentMotion) {
  for (const ForceEffect& effect : forceEffects()) {
    for (const double size : {0.0, 1e-12, 1.0, 1e3})
      for (const bool largest : {false, true})
        for (const double sign : {-1.0, 1.0}) {
          std::vector<double> shapes;
          for (const ShapeParameter& shape : effect.shapes) shapes.push_back(largest ? shape.max : shape.min);
          const StrutMotion motion{sign * size, -sign * size, 1e4, {sign, sign}};
          EXPECT_TRUE(std::isfinite(effect.force(motion, shapes.data()))) << effect.name;
          const Memory rate = effect.memory_rate ? effect.memory_rate(motion, shapes.data()) : Memory();
          EXPECT_TRUE(std::isfinite(rate.s) && std::isfinite(rate.second)) << effect.name;
        }
    const StrutMotion rest{0.0, 0.0, 100.0, 0.0};
    const std::vector<double> shapes(effect.shapes.size(), 1.0);
    EXPECT_EQ(effect.force(rest, shapes.data()), 0.0) << effect.name << " at rest";
  }
}

TEST(EffectCatalogue, UnknownNameIsRefusedWithTheKnownOnes) {
  try {
    findEffect(forceEffects(), "anti_gravity");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("anti_gravity"), std::string::npos);
    for (const ForceEffect& effect : forceEffects())
      EXPECT_NE(std::string(error.what()).find(effect.name), std::string::npos) << effect.name;
  }
}

const MeasurementEffect& reading(const std::string& name) {
  for (const MeasurementEffect& effect : measurementEffects())
    if (effect.name == name) return effect;
  throw std::invalid_argument(name);
}

TEST(MeasurementEffect, PositiveClockOffsetDelaysASineUpToThreeQuartersOfNyquistsFrequency) {
  constexpr double period = 0.01;
  for (const double omega : {10.0, 100.0, 0.5 * 314.0, 0.75 * 314.0})
    for (const double delay : {0.0, 0.003, -0.004, 0.023, 0.02}) {
      std::vector<double> predicted;
      for (int k = 0; k < 200; ++k) predicted.push_back(3.0 + std::sin(omega * k * period));
      reading("clock_offset").apply(&delay, {}, period, predicted);
      for (std::size_t k = 16; k < 184; ++k)
        ASSERT_NEAR(predicted[k], 3.0 + std::sin(omega * (static_cast<double>(k) * period - delay)), 4e-3)
            << omega << ' ' << delay;
    }
}

TEST(MeasurementEffect, ClockOffsetIsSmoothInTheOffset) {
  std::vector<double> y;
  for (int k = 0; k < 60; ++k) y.push_back(std::sin(1.3 * k));
  const auto middle = [&](double delay) {
    std::vector<double> predicted = y;
    reading("clock_offset").apply(&delay, {}, 1.0, predicted);
    return predicted[30];
  };
  for (const double delay : {-1.0, -0.4, 0.0, 0.7, 1.0}) {  // y' = -1.3 cos(1.3 (30 - delay)), on either side
    constexpr double h = 1e-6;
    EXPECT_NEAR((middle(delay + h) - middle(delay)) / h, -1.3 * std::cos(1.3 * (30.0 - delay)), 1e-2) << delay;
    EXPECT_NEAR((middle(delay) - middle(delay - h)) / h, -1.3 * std::cos(1.3 * (30.0 - delay)), 1e-2) << delay;
  }
}

TEST(MeasurementEffect, ClockOffsetOfMoreThanTheSeriesIsFinite) {
  for (const double delay : {1e9, -1e9}) {
    std::vector<double> predicted{1.0, 2.0, 4.0};
    reading("clock_offset").apply(&delay, {}, 0.01, predicted);
    for (const double y : predicted) EXPECT_TRUE(std::isfinite(y));
  }
}

TEST(MeasurementEffect, BiasAddsAndScaleErrorMultiplies) {
  std::vector<double> biased{1.0, -2.0, 4.0}, scaled = biased;
  const double bias = 0.5, gain = -0.25;
  reading("accelerometer_bias").apply(&bias, {}, 0.01, biased);
  EXPECT_EQ(biased, (std::vector<double>{1.5, -1.5, 4.5}));
  reading("scale_error").apply(&gain, {}, 0.01, scaled);
  EXPECT_EQ(scaled, (std::vector<double>{0.75, -1.5, 3.0}));
}

TEST(MeasurementEffect, ScalesAreThoseOfTheResidual) {
  const ReadingSizes sizes{0.2, 2.0, 0.01, {4.0, 5.0, 8.0, 10.0}};
  EXPECT_NEAR(reading("clock_offset").scale(sizes, 0), 0.001, 1e-15);  // [s]
  EXPECT_NEAR(reading("accelerometer_bias").scale(sizes, 0), 0.2, 1e-15);
  EXPECT_NEAR(reading("scale_error").scale(sizes, 0), 0.1, 1e-15);
  EXPECT_NEAR(reading("mount_tilt").scale(sizes, 0), 0.05, 1e-15);
  EXPECT_NEAR(reading("mount_tilt").scale(sizes, 1), 0.04, 1e-15);
  EXPECT_NEAR(reading("lever_arm").scale(sizes, 0), 0.02, 1e-15);   // r_x goes with w_y'
  EXPECT_NEAR(reading("lever_arm").scale(sizes, 1), 0.025, 1e-15);  // r_y with w_x'
}

TEST(MeasurementEffect, TiltLeaksTheAccelerationsAcross) {
  const double c[] = {0.1, -0.01};
  std::vector<double> predicted{1.0, 2.0};
  reading("mount_tilt").apply(c, {{{3.0, 4.0}, {5.0, -6.0}, {7.0, 7.0}, {8.0, 8.0}}}, 0.01, predicted);
  EXPECT_NEAR(predicted[0], 1.0 + 0.3 - 0.05, 1e-15);
  EXPECT_NEAR(predicted[1], 2.0 + 0.4 + 0.06, 1e-15);
}

TEST(MeasurementEffect, LeverArmAddsTheVerticalPartOfTheAngularAcceleration) {
  // Turning about y takes the nose down: a sensor ahead of the strut (r_x > 0) is accelerated downwards.
  const double r[] = {0.5, 0.2};
  std::vector<double> predicted{1.0, 2.0};
  reading("lever_arm").apply(r, {{{3.0, 3.0}, {5.0, 5.0}, {7.0, -1.0}, {-8.0, 4.0}}}, 0.01, predicted);
  EXPECT_NEAR(predicted[0], 1.0 + 0.2 * 7.0 + 0.5 * 8.0, 1e-15);
  EXPECT_NEAR(predicted[1], 2.0 - 0.2 * 1.0 - 0.5 * 4.0, 1e-15);
}

TEST(MeasurementEffect, UnknownChannelsLeakNothing) {
  const double c[] = {0.1, 0.1};
  for (const char* name : {"mount_tilt", "lever_arm"}) {
    std::vector<double> predicted{1.0, 2.0};
    reading(name).apply(c, {}, 0.01, predicted);
    EXPECT_EQ(predicted, (std::vector<double>{1.0, 2.0})) << name;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
