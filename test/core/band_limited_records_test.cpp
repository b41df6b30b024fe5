// Records whose noise, if any, ends where the sensor's filter does; and laws of textbooks, simulated apart from the
// library.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "driven_mass.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {
namespace {

using Names = std::vector<std::string>;

// An oscillator with a cubic spring, in the units of an electronic one: 68 Hz, sampled at 610 Hz, shaken up to 200 Hz.
DrivenMass duffing(int seed) {
  const double omega = 2.0 * M_PI * 68.0, b1 = 0.2 * omega, b0 = omega * omega;
  return {610.0, BandNoise(seed, 0.0, 200.0, 2e5),
          [=](const MassState& x, double) { return b1 * x.v + b0 * x.d * (1.0 + 0.15 * x.d * x.d); }};
}

TEST(BandLimitedRecords, ACubicSpringWithoutAnyNoiseIsFoundAlone) {
  for (int seed = 1; seed <= 3; ++seed) {
    const Diagnosis found = diagnose({duffing(seed).drive(4000)});
    ASSERT_TRUE(found) << found.reason;
    EXPECT_EQ(found.verdict, Verdict::kEffectFound);
    EXPECT_EQ(found.selected, Names{"progressive_spring"});
    EXPECT_TRUE(found.indistinguishable.empty());
    EXPECT_LT(20.0 * found.extended->held_out_rmse, found.base.held_out_rmse);
    const ActiveEffect& spring = found.model().effects.at(0);
    EXPECT_NEAR(spring.shapes.at(0), 3.0, 0.03);
    EXPECT_NEAR(spring.coefficient / (0.15 * std::pow(2.0 * M_PI * 68.0, 2)), 1.0, 0.05);
  }
}

DrivenMass linearStrut(double noise_in_band) {
  return {100.0,
          BandNoise(1, 0.2, 20.0, 3.0),
          [](const MassState& x, double) { return 6.0 * x.v + 63.0 * x.d; },
          [](const MassState&) { return 0.0; },
          0.0,
          BandNoise(2, 0.1, 20.0, noise_in_band)};
}

TEST(BandLimitedRecords, NoiseThatTheSensorHasFilteredIsNoStructure) {
  const Diagnosis found = diagnose({linearStrut(0.05).drive(6000)});
  ASSERT_TRUE(found) << found.reason;
  EXPECT_EQ(found.verdict, Verdict::kNothingMissing);
  EXPECT_NEAR(found.noise_floor, 0.05, 0.005);
  const Comparison compared = compare({linearStrut(0.05).drive(6000)});
  ASSERT_TRUE(compared) << compared.reason;
  EXPECT_LT(compared.structured_share, 0.2);
}

TEST(BandLimitedRecords, NoiseOfAWheelSensorThatIsTenTimesAsLoudIsNoStructure) {
  Drive drive = linearStrut(0.0).drive(24000);
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (CornerSample& sample : drive.samples) {
    sample.sprung_acceleration += noise(generator);
    sample.unsprung_acceleration += 10.0 * noise(generator);
  }
  // 1 + r T (b1^2 + b0) / (2 b1) with r = 100.
  const double floor = 0.02 * std::sqrt(1.0 + 100.0 * 0.01 * (36.0 + 63.0) / 12.0);  // 3 % of chance: 240 s, 1.5 Hz
  const Diagnosis found = diagnose({drive});
  ASSERT_TRUE(found) << found.reason;
  EXPECT_EQ(found.verdict, Verdict::kNothingMissing);
  EXPECT_NEAR(found.noise_floor, floor, 0.1 * floor);
  const Comparison compared = compare({drive});
  ASSERT_TRUE(compared) << compared.reason;
  EXPECT_LT(compared.structured_share, 0.2);
  EXPECT_TRUE(compared.views.whiteness.within);
}

TEST(BandLimitedRecords, OneLineOfForceIsNoNoise) {
  DrivenMass strut = linearStrut(0.0);
  strut.force = [](const MassState& x, double t) {
    return 6.0 * x.v + 63.0 * x.d + 0.2 * std::sin(2.0 * M_PI * 1.9 * t);
  };
  const Diagnosis found = diagnose({strut.drive(6000)});
  ASSERT_TRUE(found) << found.reason;
  EXPECT_EQ(found.verdict, Verdict::kUnexplained);
}

TEST(BandLimitedRecords, NothingIsNamedThatTheFreeRunCannotResolve) {
  const Diagnosis found = diagnose({linearStrut(0.0).drive(6000)});
  ASSERT_TRUE(found) << found.reason;
  EXPECT_EQ(found.verdict, Verdict::kNothingMissing);
  EXPECT_LT(found.base.held_out_rmse, 1e-3);
}

// 2 kg, 10 N s/m, 5e4 N/m beside z' = 5e4 v - 800 |v| z + 1100 v |z|.
TEST(TextbookLaws, BoucWenHysteresisIsNamedAlone) {
  for (int seed = 1; seed <= 2; ++seed) {
    const DrivenMass oscillator{
        750.0, BandNoise(seed, 5.0, 150.0, 30.0),
        [](const MassState& x, double) { return (10.0 * x.v + 5e4 * x.d + x.s) / 2.0; },
        [](const MassState& x) { return 5e4 * x.v - 800.0 * std::abs(x.v) * x.s + 1100.0 * x.v * std::abs(x.s); },
        0.01};
    const Diagnosis found = diagnose({oscillator.drive(8000, seed)});
    ASSERT_TRUE(found) << found.reason;
    EXPECT_EQ(found.verdict, Verdict::kEffectFound);
    EXPECT_EQ(found.selected, Names{"bouc_wen"});
    EXPECT_LT(20.0 * found.extended->held_out_rmse, found.base.held_out_rmse);
    const ActiveEffect& law = found.model().effects.at(0);
    EXPECT_NEAR(law.coefficient, 2.5e4, 750.0);
    EXPECT_NEAR(law.shapes.at(0), 1.0 / 800.0, 4e-5);
    EXPECT_NEAR(law.shapes.at(1), 1.0 / 1100.0, 4e-5);
  }
}

// A spring and mount in series would do the same without the strut's own spring; that carries the body.
TEST(TextbookLaws, TheDragOfTheBodyIsNoMount) {
  const DrivenMass strut{100.0, BandNoise(3, 0.3, 12.0, 3.0),
                         [](const MassState& x, double) { return 6.0 * x.v + 63.0 * x.d - 0.8 * x.body; },
                         [](const MassState&) { return 0.0; }, 0.03};
  const Diagnosis found = diagnose({strut.drive(12000)});
  ASSERT_TRUE(found) << found.reason;
  EXPECT_EQ(found.verdict, Verdict::kEffectFound);
  EXPECT_EQ(found.selected, Names{"body_drag"});
  EXPECT_NEAR(found.model().effects.at(0).coefficient, 0.8, 0.05);
  EXPECT_NEAR(found.model().stiffness_to_mass, 63.0, 1.0);
}

// From 0.5 to 8 Hz, with an actuator that follows the drive.
TEST(TextbookLaws, ASweepWithAnActuatorNamesNoDrift) {
  const auto sweep = [](double t) { return 3.0 * std::sin(2.0 * M_PI * (0.5 * t + 7.5 / 240.0 * t * t)); };
  const DrivenMass strut{
      100.0, sweep,
      [&](const MassState& x, double t) { return 6.0 * x.v + 63.0 * x.d + 0.15 * sweep(t - 0.03) - 0.5 * x.body; },
      [](const MassState&) { return 0.0; }, 0.03};
  const Diagnosis found = diagnose({strut.drive(12000)});
  ASSERT_TRUE(found) << found.reason;
  for (const std::string& name : found.selected) EXPECT_EQ(name.find("drift"), std::string::npos) << name;
}

}  // namespace
}  // namespace suspension_health_monitor
