// The monitor with fastest_forgetting_factor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "first_alarms.h"
#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/model/effect_catalogue.h"
#include "suspension_health_monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSlow = 0.995, kFastest = 0.97;
constexpr int kFirstSeed = 301, kNumSeeds = 15;

MonitorOptions optionsWith(double slow, std::optional<double> fastest) {
  MonitorOptions options = liveOptions();
  options.forgetting_factor = slow;
  options.fastest_forgetting_factor = fastest;
  return options;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

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
  return median(times);
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
    EXPECT_GE(factor, kFastest);
    EXPECT_LE(factor, slow);
    if (toSeconds(sample.stamp) > 15.0) farthest = std::max(farthest, (slow - factor) / (slow - kFastest));
  }
  return farthest;
}

// Wrong readings move lambda by chance, by less than three quarters of the way, and mostly not at all: T may reach t, not 2 t.
TEST(VaryingMonitor, WrongReadingsAloneDoNotOpenIt) {
  using Spoil = std::function<void(SimulationOptions&, std::vector<CornerSample>&)>;
  const auto burst = [](int readings, double sprung, double unsprung) {
    return [=](SimulationOptions&, std::vector<CornerSample>& drive) {
      for (std::size_t k = 3000; !drive.empty() && k < 3000 + static_cast<std::size_t>(readings); ++k) {
        drive[k].sprung_acceleration += sprung;
        drive[k].unsprung_acceleration += unsprung;
      }
    };
  };
  const std::vector<std::pair<std::string, Spoil>> kinds{
      {"data loss", [](SimulationOptions& drive, auto&) { drive.scenario = "paper_outliers"; }},
      {"end stops", [](SimulationOptions& drive, auto&) { drive.scenario = "paper_saturation"; }},
      {"a spike of the body", burst(1, 20.0, 0.0)},
      {"a spike of the wheel", burst(1, 0.0, 20.0)},
      {"a burst of the body", burst(10, 20.0, 0.0)},
      {"a burst of the wheel", burst(10, 0.0, -20.0)}};
  for (const double slow : {0.99, kSlow})
    for (const auto& [name, spoil] : kinds) {
      std::vector<double> worst;
      for (int seed = kFirstSeed; seed < kFirstSeed + kNumSeeds; ++seed) {
        SimulationOptions options;
        options.damping_ramp = false;
        options.duration = 90.0;
        options.seed = seed;
        std::vector<CornerSample> drive;
        spoil(options, drive);
        drive = simulate(options);
        spoil(options, drive);
        worst.push_back(farthest(drive, slow));
      }
      EXPECT_LT(median(worst), 0.1) << name << ' ' << slow;
      EXPECT_LT(*std::max_element(worst.begin(), worst.end()), 0.75) << name << ' ' << slow;
    }
}

// The paper's strut with another unit of length, and as a part of 68 Hz.
TEST(VaryingMonitor, TheScaleOfDataAndTimeDoesNotMatter) {
  constexpr double kQuicker = 115.0, kSmaller = 1e-4;
  SimulationOptions drive;
  drive.seed = 303;
  MonitorOptions options = optionsWith(kSlow, kFastest), small = options;
  options.horizon_samples = small.horizon_samples = 30;
  small.sample_period = 0.02 / kQuicker;
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

TEST(VaryingMonitor, WithItsSlowFactorAsTheFastestItIsTheConstantOne) {
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

TEST(VaryingMonitor, StaysValidWithTheFewerRowsOfItsFastestFactor) {
  SimulationOptions drive;
  drive.seed = 302;
  SuspensionMonitor monitor(optionsWith(kSlow, 0.95));
  double fewest = 200.0;
  for (const CornerSample& sample : simulate(drive)) {
    monitor.addSample(sample);
    if (toSeconds(sample.stamp) < 10.0) continue;
    ASSERT_TRUE(monitor.report().la.valid) << toSeconds(sample.stamp);
    fewest = std::min(fewest, monitor.report().la.effective_rows);
  }
  EXPECT_LT(fewest, 50.0);  // valid/min_rows
}

// As Health.WarnsWithinFiveSecondsOfTheThresholdsOnThePapersRamp, with the trends over the present memory.
TEST(VaryingMonitor, HealthWarnsWithinFiveSecondsOnThePapersRamp) {
  MonitorOptions options = optionsWith(0.99, kFastest);
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

TEST(VaryingMonitor, IsReconfiguredWithoutLosingItsEstimates) {
  const std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  SuspensionMonitor monitor(optionsWith(0.99, std::nullopt));
  std::size_t k = 0;
  for (; k < 1500; ++k) monitor.addSample(drive[k]);
  const double before = monitor.report().la.damping_to_mass;
  monitor.reconfigure(optionsWith(kSlow, kFastest));
  ASSERT_EQ(monitor.forgettingFactor(), kSlow);
  monitor.addSample(drive[k++]);
  EXPECT_NEAR(monitor.report().la.damping_to_mass, before, 0.02);
  EXPECT_TRUE(monitor.report().la.valid);
  EXPECT_THROW(monitor.reconfigure(optionsWith(0.95, kFastest)), std::invalid_argument);
  EXPECT_EQ(monitor.forgettingFactor(), kSlow);
  EXPECT_EQ(monitor.options().forgetting_factor, kSlow);
  for (; k < drive.size(); ++k) monitor.addSample(drive[k]);
  EXPECT_GT(monitor.report().la.effective_rows, 150.0);
}

TEST(VaryingMonitor, TheSameOptionsChangeNothing) {
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
TEST(VaryingMonitor, StandardDeviationsAreNumbersAfterAShorterMemoryIsSet) {
  const std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  SuspensionMonitor monitor(optionsWith(0.998, std::nullopt));
  std::size_t k = 0;
  for (; k < 2500; ++k) monitor.addSample(drive[k]);
  monitor.reconfigure(optionsWith(0.98, std::nullopt));
  for (; k < drive.size(); ++k) {
    monitor.addSample(drive[k]);
    ASSERT_TRUE(monitor.report().la.valid) << toSeconds(drive[k].stamp);
    ASSERT_GT(monitor.report().ls.damping_to_mass_stddev, 0.0);
  }
}

TEST(VaryingMonitor, GoesOnWithEffectsInTheModel) {
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
    ASSERT_GE(monitor.forgettingFactor(), kFastest);
  }
  EXPECT_EQ(monitor.effects().size(), 1u);
  EXPECT_LT(least, 0.98);
}

// A parked vehicle has nothing to forget: lambda, too, stays as it is.
TEST(VaryingMonitor, StaysWhereItIsWithoutExcitation) {
  SimulationOptions drive;
  drive.seed = 305;
  drive.noise = 0.0;
  drive.ramp_start = 40.0;
  drive.ramp_end = 40.02;
  drive.damping_end_fraction = 0.8;
  const std::vector<CornerSample> samples = simulate(drive);
  SuspensionMonitor monitor(optionsWith(kSlow, kFastest));
  std::size_t k = 0;
  while (k < samples.size() && monitor.forgettingFactor() > 0.98) monitor.addSample(samples[k++]);
  ASSERT_LT(k, samples.size());
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 1e-4);
  Stamp stamp = samples[k - 1].stamp;
  const auto park = [&](int rows) {
    for (int i = 0; i < rows; ++i) {
      stamp += std::chrono::milliseconds(20);
      monitor.addSample({stamp, noise(generator), noise(generator)});
    }
  };
  park(3000);  // until the drive has left filter and means
  ASSERT_EQ(monitor.report().la.doubt, EstimateDoubt::kNotExcited);
  const double held = monitor.forgettingFactor();
  park(5000);
  EXPECT_EQ(monitor.forgettingFactor(), held);
}

std::string complaint(double slow, double fastest) {
  try {
    optionsWith(slow, fastest).validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(VaryingMonitor, AFastestFactorOutOfRangeOrAboveTheSlowOneIsRefused) {
  EXPECT_EQ(complaint(0.99, 0.99), "");
  EXPECT_EQ(complaint(1.0, 0.9), "");
  const std::string slower = complaint(0.98, 0.99);
  EXPECT_NE(slower.find("fastest_forgetting_factor = 0.99"), std::string::npos) << slower;
  EXPECT_NE(slower.find("at most forgetting_factor = 0.98"), std::string::npos) << slower;
  for (const double outside : {0.5, 1.5, std::nan("")}) {
    const std::string message = complaint(0.99, outside);
    EXPECT_NE(message.find("fastest_forgetting_factor"), std::string::npos) << outside << message;
    EXPECT_NE(message.find("must be in [0.9, 1]"), std::string::npos) << outside << message;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
