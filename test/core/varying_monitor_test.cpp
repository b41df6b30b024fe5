// How the monitor follows with fastest_memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "first_alarms.h"
#include "monitor_settings.h"
#include "paper_drive.h"
#include "simulated_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSlow = 0.995, kFastest = 0.97;
constexpr int kFirstSeed = 301, kNumSeeds = 15;

// Until 15 % of 20 % have been seen by LA.
double seenAfter(double slow, std::optional<double> fastest) {
  constexpr double kStepAt = 40.0;
  std::vector<double> times;
  for (int seed = kFirstSeed; seed < kFirstSeed + kNumSeeds; ++seed) {
    SimulationOptions drive;
    drive.seed = seed;
    drive.duration = 80.0;
    drive.ramp_start = kStepAt;
    drive.ramp_end = kStepAt + 0.02;
    drive.damping_end_fraction = 0.8;
    SuspensionMonitor monitor(optionsWith(slow, fastest));
    double seen = drive.duration - kStepAt;
    for (const CornerSample& sample : simulate(drive)) {
      monitor.addSample(sample);
      const double after = toSeconds(sample.stamp) - kStepAt;
      if (after > 0.0 && after < seen && monitor.report().la.damping_to_mass < 0.85 * kPaperB1) seen = after;
    }
    times.push_back(seen);
  }
  return medianOf(times);
}

// On 30 other seeds 0.53 of 10 s, with quartiles that are 0.4 s apart.
TEST(VaryingMonitor, SeesAStepInAboutHalfTheTimeOfItsSlowFactor) {
  const double slow = seenAfter(kSlow, std::nullopt), varying = seenAfter(kSlow, kFastest);
  EXPECT_GT(slow, 8.0);
  EXPECT_LT(varying, 0.62 * slow);
  EXPECT_GT(varying, seenAfter(kFastest, std::nullopt));
}

// While nothing changes lambda is the slow factor but for chance: 2 % more scatter at the most.
TEST(VaryingMonitor, ScattersAsItsSlowFactorWhileNothingChanges) {
  double slow[2] = {}, varying[2] = {};
  for (int seed = kFirstSeed; seed < kFirstSeed + kNumSeeds; ++seed) {
    SuspensionMonitor constant(optionsWith(kSlow, std::nullopt)), monitor(optionsWith(kSlow, kFastest));
    for (const CornerSample& sample : healthyPaperDrive(60.0, 0.024, seed)) {
      constant.addSample(sample);
      monitor.addSample(sample);
      if (toSeconds(sample.stamp) < 15.0) continue;
      slow[0] += std::pow(constant.report().la.damping_to_mass - kPaperB1, 2);
      slow[1] += std::pow(constant.report().la.stiffness_to_mass - kPaperB0, 2);
      varying[0] += std::pow(monitor.report().la.damping_to_mass - kPaperB1, 2);
      varying[1] += std::pow(monitor.report().la.stiffness_to_mass - kPaperB0, 2);
    }
  }
  EXPECT_LT(std::sqrt(varying[0]), 1.02 * std::sqrt(slow[0]));
  EXPECT_LT(std::sqrt(varying[1]), 1.02 * std::sqrt(slow[1]));
}

/// How far lambda falls, as a share of the way, once the drive has settled.
double farthest(const std::vector<CornerSample>& drive, double slow) {
  SuspensionMonitor monitor(optionsWith(slow, kFastest));
  double farthest = 0.0;
  for (const CornerSample& sample : drive) {
    monitor.addSample(sample);
    const double factor = monitor.forgettingFactor();
    EXPECT_GE(factor, kFastest - 1e-12);
    EXPECT_LE(factor, slow);
    if (toSeconds(sample.stamp) > 15.0) farthest = std::max(farthest, (slow - factor) / (slow - kFastest));
  }
  return farthest;
}

// Wrong readings move lambda by chance, by less than three quarters of the way, and mostly not at all: T may reach t,
// not 2 t. On 200 other seeds the upper quartile of any kind is 0.12 at most, so that the median of 15 is above 0.1
// once in 50 times; of these 2400 drives 0.5 % go beyond 0.5 and none beyond 0.59: each 0.15 more is ten times as rare.
TEST(VaryingMonitor, WrongReadingsAloneDoNotOpenIt) {
  struct Kind {
    const char *name, *scenario;
    std::size_t readings;  // in a row that are wrong
    double sprung, unsprung;
  };
  for (const double slow : {0.99, kSlow})
    for (const Kind& kind : {Kind{"data loss", "paper_outliers", 0, 0.0, 0.0},
                             {"end stops", "paper_saturation", 0, 0.0, 0.0},
                             {"a spike of the body", "paper_clean", 1, 20.0, 0.0},
                             {"a spike of the wheel", "paper_clean", 1, 0.0, 20.0},
                             {"a burst of the body", "paper_clean", 10, 20.0, 0.0},
                             {"a burst of the wheel", "paper_clean", 10, 0.0, -20.0}}) {
      std::vector<double> worst;
      for (int seed = kFirstSeed; seed < kFirstSeed + kNumSeeds; ++seed) {
        SimulationOptions options;
        options.damping_end_fraction = 1.0;
        options.duration = 90.0;
        options.seed = seed;
        options.scenario = kind.scenario;
        std::vector<CornerSample> drive = simulate(options);
        for (std::size_t k = 3000; k < 3000 + kind.readings; ++k) {
          drive[k].sprung_acceleration += kind.sprung;
          drive[k].unsprung_acceleration += kind.unsprung;
        }
        worst.push_back(farthest(drive, slow));
      }
      EXPECT_LT(medianOf(worst), 0.1) << kind.name << ' ' << slow;
      EXPECT_LT(*std::max_element(worst.begin(), worst.end()), 0.75) << kind.name << ' ' << slow;
    }
}

// The paper's strut with another unit of length, and as a part of 68 Hz.
TEST(VaryingMonitor, TheScaleOfDataAndTimeDoesNotMatter) {
  constexpr double kQuicker = 115.0, kSmaller = 1e-4;
  SimulationOptions drive;
  drive.seed = 303;
  MonitorSettings options = optionsWith(kSlow, kFastest), small = options;
  options.integration_horizon = 30 * *options.sample_period;
  small.sample_period = 0.02 / kQuicker;
  small.integration_horizon = 30 * *small.sample_period;
  small.fastest_memory = *options.fastest_memory / kQuicker;
  SuspensionMonitor truck(options), part(small);
  double least = kSlow;
  std::int64_t number = 0;
  for (const CornerSample& sample : simulate(drive)) {
    truck.addSample(sample);
    part.addSample({fromSeconds(*small.sample_period * static_cast<double>(number++)),
                    kSmaller * sample.sprung_acceleration, kSmaller * sample.unsprung_acceleration});
    ASSERT_NEAR(truck.forgettingFactor(), part.forgettingFactor(), 1e-6) << toSeconds(sample.stamp);
    least = std::min(least, truck.forgettingFactor());
  }
  EXPECT_LT(least, 0.98);  // the ramp
  EXPECT_NEAR(part.report().la.damping_to_mass, kQuicker * truck.report().la.damping_to_mass, 1e-4 * kQuicker);
}

// As Health.WarnsWithinFiveSecondsOfTheThresholdsOnThePapersRamp, with the trends over the present memory.
TEST(VaryingMonitor, HealthWarnsWithinFiveSecondsOnThePapersRamp) {
  MonitorSettings options = optionsWith(0.99, kFastest);
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  for (int seed = 1; seed <= kNumSeeds; ++seed) {
    SimulationOptions drive;
    drive.seed = seed;
    const FirstAlarms first = firstAlarms(simulate(drive), options);
    ASSERT_TRUE(first.early && first.warn && first.error) << seed;
    EXPECT_NEAR(*first.warn, 67.0, 5.0) << seed;
    EXPECT_NEAR(*first.error, 94.0, 5.0) << seed;
    EXPECT_GT(*first.early, 40.0) << seed;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
