// fastest_memory as a setting, and beside others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSlow = 0.995, kFastest = 0.97;

TEST(VaryingSettings, WithItsSlowFactorAsTheFastestItIsTheConstantOne) {
  SuspensionMonitor constant(optionsWith(kSlow, std::nullopt)), same(optionsWith(kSlow, kSlow));
  for (const CornerSample& sample : simulate({})) {
    constant.addSample(sample);
    same.addSample(sample);
    ASSERT_EQ(constant.forgettingFactor(), kSlow);
    ASSERT_EQ(same.forgettingFactor(), kSlow);
  }
  const StrutEstimate &one = constant.report().la, &other = same.report().la;
  EXPECT_EQ(one.damping_to_mass, other.damping_to_mass);
  EXPECT_EQ(one.stiffness_to_mass_stddev, other.stiffness_to_mass_stddev);
  EXPECT_EQ(constant.report().ls.stiffness_to_mass, same.report().ls.stiffness_to_mass);
}

TEST(VaryingSettings, StaysValidWithTheFewerRowsOfItsFastestFactor) {
  SimulationOptions drive;
  drive.seed = 302;
  SuspensionMonitor monitor(optionsWith(kSlow, 0.95));
  double fewest = 200.0;
  for (const CornerSample& sample : simulate(drive)) {
    monitor.addSample(sample);
    if (toSeconds(sample.stamp) < 10.0) continue;
    ASSERT_TRUE(monitor.report().la.valid()) << toSeconds(sample.stamp);
    fewest = std::min(fewest, monitor.report().la.effective_rows);
  }
  EXPECT_LT(fewest, 50.0);  // a second
}

TEST(VaryingSettings, IsReconfiguredWithoutLosingItsEstimates) {
  const std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  SuspensionMonitor monitor(optionsWith(0.99, std::nullopt));
  std::size_t k = 0;
  for (; k < 1500; ++k) monitor.addSample(drive[k]);
  const double before = monitor.report().la.damping_to_mass;
  monitor.reconfigure(optionsWith(kSlow, kFastest));
  ASSERT_EQ(monitor.forgettingFactor(), kSlow);
  monitor.addSample(drive[k++]);
  EXPECT_NEAR(monitor.report().la.damping_to_mass, before, 0.02);
  EXPECT_TRUE(monitor.report().la.valid());
  EXPECT_THROW(monitor.reconfigure(optionsWith(0.95, kFastest)), std::invalid_argument);
  EXPECT_EQ(monitor.forgettingFactor(), kSlow);
  EXPECT_EQ(monitor.options().forgetting_factor, kSlow);
  for (; k < drive.size(); ++k) monitor.addSample(drive[k]);
  EXPECT_GT(monitor.report().la.effective_rows, 150.0);
}

TEST(VaryingSettings, TheSameOptionsChangeNothing) {
  SuspensionMonitor left_alone(optionsWith(kSlow, kFastest)), reconfigured(optionsWith(kSlow, kFastest));
  double least = kSlow;
  for (const CornerSample& sample : simulate({})) {
    left_alone.addSample(sample);
    reconfigured.reconfigure(reconfigured.options());
    reconfigured.addSample(sample);
    ASSERT_EQ(reconfigured.forgettingFactor(), left_alone.forgettingFactor());
    least = std::min(least, left_alone.forgettingFactor());
  }
  EXPECT_LT(least, 0.98);
  EXPECT_EQ(reconfigured.report().la.damping_to_mass, left_alone.report().la.damping_to_mass);
}

// A memory that was longer counts for a while: 500 rows at 1/50 would make a negative variance of 2 - 10.
TEST(VaryingSettings, StandardDeviationsAreNumbersAfterAShorterMemoryIsSet) {
  const std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  SuspensionMonitor monitor(optionsWith(0.998, std::nullopt));
  std::size_t k = 0;
  for (; k < 2500; ++k) monitor.addSample(drive[k]);
  monitor.reconfigure(optionsWith(0.98, std::nullopt));
  for (; k < drive.size(); ++k) {
    monitor.addSample(drive[k]);
    ASSERT_TRUE(monitor.report().la.valid()) << toSeconds(drive[k].stamp);
    ASSERT_GT(monitor.report().ls.damping_to_mass_stddev, 0.0);
  }
}

TEST(VaryingSettings, GoesOnWithEffectsInTheModel) {
  SimulationOptions drive;
  drive.seed = 304;
  drive.ramp_start = 60.0;
  drive.ramp_end = 60.02;
  drive.damping_end_fraction = 0.6;
  SuspensionMonitor monitor(optionsWith(kSlow, kFastest));
  double least = kSlow;
  for (const CornerSample& sample : simulate(drive)) {
    if (sample.stamp == fromSeconds(30.0))
      monitor.setEffects({{findEffect(forceEffects(), "quadratic_damping"), 0.0, {}}});
    monitor.addSample(sample);
    least = std::min(least, monitor.forgettingFactor());
    ASSERT_GE(monitor.forgettingFactor(), kFastest - 1e-12);
  }
  EXPECT_EQ(monitor.effects().size(), 1u);
  EXPECT_LT(least, 0.98);
}

// Of a strut that is parked nobody knows whether it moves on, though the rows before the stop said so: they are of the
// damper's ramp.
TEST(VaryingSettings, IsTheSlowOneOnceNothingIsExcited) {
  SimulationOptions drive;
  drive.noise = 0.0;
  const std::vector<CornerSample> samples = simulate(drive);
  SuspensionMonitor monitor(optionsWith(kSlow, kFastest));
  std::size_t k = 0;
  while (k < 2575) monitor.addSample(samples[k++]);
  ASSERT_LT(monitor.forgettingFactor(), kSlow);
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 1e-4);
  Stamp stamp = samples[k - 1].stamp;
  double before = kSlow;
  for (int i = 0; i < 1000 && monitor.report().la.doubt != EstimateDoubt::kNotExcited; ++i) {
    if (monitor.report().la.valid()) before = monitor.forgettingFactor();
    stamp += std::chrono::milliseconds(20);
    monitor.addSample({stamp, noise(generator), noise(generator)});
  }
  ASSERT_EQ(monitor.report().la.doubt, EstimateDoubt::kNotExcited);
  EXPECT_LT(before, kSlow);
  EXPECT_EQ(monitor.forgettingFactor(), kSlow);
}

std::string complaint(double slow, double fastest) {
  try {
    optionsWith(slow, fastest).validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(VaryingSettings, AFastestFactorOutOfRangeOrAboveTheSlowOneIsRefused) {
  EXPECT_EQ(complaint(0.99, 0.98), "");
  EXPECT_EQ(complaint(1.0, 0.9), "");
  EXPECT_EQ(complaint(0.98, 0.99), "fastest_memory = 2 [s], must be at most that of forgetting_factor = 0.98");
  EXPECT_EQ(complaint(0.99, 0.5),
            "fastest_memory = 0.04 [s], must be at least 0.2 [s], ten samples of sample_period = 0.02 [s]");
  EXPECT_NE(complaint(0.99, std::nan("")).find("fastest_memory = nan [s], must be in"), std::string::npos);
  MonitorSettings by_time;
  by_time.fastest_memory = 3.0;  // above the memory, which is told without the period
  EXPECT_THROW(by_time.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
