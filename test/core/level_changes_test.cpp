#include "suspension_health_monitor/internal/identification/level_changes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../../benchmark/field_monitor.h"
#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01, kForgetting = 0.995;  // [s]; a memory of 2 s
const int kFull = SlowMean(kPeriod).fills();           // rows

/// Adds value(k) for rows k = 0 to num - 1.
template <class Value>
void add(LevelChanges& changes, int num, const Value& value) {
  for (int k = 0; k < num; ++k) changes.add(value(k), value(k), true);
}

TEST(LevelChanges, AreNoneOfALevelThatStays) {
  LevelChanges changes(kPeriod, kForgetting);
  add(changes, 2 * kFull, [](int) { return 0.3; });
  EXPECT_NEAR(changes.variance(), 0.0, 1e-12);
}

// Four means over a second each turn a step into a smooth way up; its variance with the weights of the memory.
TEST(LevelChanges, AreThoseOfAStep) {
  constexpr double kStep = 0.02;
  constexpr int kRows = 500, kSecond = 100;
  LevelChanges changes(kPeriod, kForgetting);
  add(changes, 3000, [](int) { return 0.3; });
  add(changes, kRows, [](int) { return 0.3 + kStep; });
  std::vector<double> way(kRows, kStep);
  for (int mean = 0; mean < 4; ++mean)
    for (std::size_t k = way.size(); k-- > 0;) {
      double sum = 0.0;
      for (std::size_t j = 0; j < kSecond && j <= k; ++j) sum += way[k - j];
      way[k] = sum / kSecond;
    }
  double sum = 0.0, squares = 0.0;  // of the memory, the newest row first
  for (std::size_t age = 0; age < way.size(); ++age) {
    const double weight = (1.0 - kForgetting) * std::pow(kForgetting, age), level = way[way.size() - 1 - age];
    sum += weight * level;
    squares += weight * level * level;
  }
  const double expected = squares - sum * sum;
  EXPECT_GT(expected, 0.1 * kStep * kStep);
  EXPECT_NEAR(changes.variance(), expected, 0.02 * expected);
  add(changes, 4000, [](int) { return 0.3 + kStep; });
  EXPECT_LT(changes.variance(), 1e-6 * kStep * kStep);
}

TEST(LevelChanges, AreNotTheMotionOfABodyOnItsSprings) {
  for (const double frequency : {1.0, 1.3, 2.0, 5.0}) {
    LevelChanges changes(kPeriod, kForgetting);
    add(changes, 3000, [&](int k) { return std::sin(2.0 * kPi * frequency * kPeriod * k); });
    EXPECT_LT(changes.variance(), 5e-6) << frequency;  // of 1/2: the square of 0.2 %
  }
}

TEST(LevelChanges, AreNeitherSlowMotionThatTheBodyAnswersNorResidualsBesideALevelThatStays) {
  LevelChanges answered(kPeriod, kForgetting), stays(kPeriod, kForgetting);
  for (int k = 0; k < 3000; ++k) {
    const double slow = std::sin(0.5 * kPeriod * k);
    answered.add(slow, 0.0, true);
    stays.add(0.3, slow, true);
  }
  EXPECT_NEAR(answered.variance(), 0.0, 1e-12);
  EXPECT_NEAR(stays.variance(), 0.0, 1e-12);
}

TEST(LevelChanges, BeginAnewAfterAGapAndKeepWhatIsRemembered) {
  LevelChanges changes(kPeriod, kForgetting);
  add(changes, 2 * kFull, [](int) { return 0.3; });
  changes.interrupt();
  for (int k = 0; k < kFull; ++k) changes.add(5.0, 5.0, false);
  EXPECT_NEAR(changes.variance(), 0.0, 1e-12);
  add(changes, 200, [](int) { return 5.0; });
  EXPECT_GT(changes.variance(), 1.0);
}

class TiltedWheelImu : public testing::TestWithParam<int> {};

// It reads braking and pulling away, 3.75 m/s^2 of it, of which a tilt of 2 degrees makes 0.13 m/s^2.
TEST_P(TiltedWheelImu, NeitherBlamesAStrutNorIsWrongWithConfidence) {
  FieldDrive drive;
  drive.vehicle = kFieldVehicles[static_cast<std::size_t>(GetParam())];
  drive.stops = true;
  drive.tilt = 2.0 * kPi / 180.0;
  drive.seed = 40 + static_cast<unsigned>(GetParam());
  double valid = 0.0, wrong = 0.0, reports = 0.0;
  follow(drive, {}, 1800.0, [&](double time, const MonitorReport& report) {
    EXPECT_NE(report.health.level, HealthLevel::kWarn) << time;
    EXPECT_NE(report.health.level, HealthLevel::kError) << time;
    reports += 1.0;
    if (!report.la.valid()) return;
    valid += 1.0;
    const double off = report.la.stiffness_to_mass - drive.vehicle.b0;
    wrong += std::abs(off) > 3.0 * report.la.stiffness_to_mass_stddev ? 1.0 : 0.0;
  });
  EXPECT_GT(valid, 0.3 * reports);  // of two thirds in which it drives
  EXPECT_LT(wrong, 0.03 * valid);
}

INSTANTIATE_TEST_SUITE_P(Vehicles, TiltedWheelImu, testing::Range(0, 4));

}  // namespace
}  // namespace suspension_health_monitor
