// What the judgement of health promises of simulated drives.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "first_alarms.h"
#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

MonitorSettings judgedOptions() {
  MonitorSettings options = liveOptions();
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  return options;
}

HealthReport healthAfter(const std::vector<CornerSample>& drive, const MonitorSettings& options) {
  SuspensionMonitor monitor(options);
  for (const CornerSample& sample : drive) monitor.addSample(sample);
  return monitor.report().health;
}

// The damping falls from 3 to 2 1/s between 40 s and 100 s: -15 % at 67 s, -30 % at 94 s. An estimate that scatters by
// 1 % of a parameter that falls by 0.55 % a second moves the time by 2 s: doc/health.md has more drives. Of
// paper_outliers a second without readings ends a second before the warning is due: 5 s of readings are 6 s there.
// The early notice comes 4 s before the warning and more in the mean; it comes after it in 24 of 400 drives, of thirty
// in more than six but once in 400 times.
TEST(Health, WarnsWithinSecondsOfTheThresholdsOnThePapersRamp) {
  constexpr int kSeeds = 15;
  int early_is_later = 0;
  for (const auto& [scenario, warn_within] : {std::pair("paper_clean", 4.0), std::pair("paper_outliers", 6.0)}) {
    double earlier = 0.0, late = 0.0;  // [s], of the early notice before the warning; of the warning
    for (int seed = 1; seed <= kSeeds; ++seed) {
      SimulationOptions drive;
      drive.scenario = scenario;
      drive.seed = seed;
      const FirstAlarms first = firstAlarms(simulate(drive), judgedOptions());
      ASSERT_TRUE(first.early && first.warn && first.error) << scenario << ' ' << seed;
      late += *first.warn - 67.0;
      EXPECT_NEAR(*first.warn, 67.0, 2.0 * warn_within) << scenario << ' ' << seed;
      EXPECT_NEAR(*first.error, 94.0, 6.0) << scenario << ' ' << seed;
      early_is_later += *first.early > *first.warn ? 1 : 0;
      EXPECT_GT(*first.early, 40.0) << scenario << ' ' << seed;
      earlier += *first.warn - *first.early;
    }
    EXPECT_LT(late / kSeeds, warn_within) << scenario;
    EXPECT_GT(earlier / kSeeds, 4.0) << scenario;
  }
  EXPECT_LE(early_is_later, 6);
}

// With the paper's settings a standard deviation of the change is up to 4 %, twice the hysteresis. Once in 30 drives is
// measured over 60; so fifteen have at most three, but once in 500 times.
TEST(Health, LevelsDoNotFlickerOnTheWayDown) {
  MonitorSettings options = paperOptions();
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  int taken_back = 0, errors = 0;
  for (int seed = 1; seed <= 15; ++seed) {
    SimulationOptions drive;
    drive.seed = seed;
    SuspensionMonitor monitor(options);
    HealthLevel worst = HealthLevel::kOk, before = worst;
    for (const CornerSample& sample : simulate(drive)) {
      monitor.addSample(sample);
      const HealthLevel now = monitor.report().health.level;
      if (toSeconds(sample.stamp) < 60.0 || now == before || now == HealthLevel::kStale) continue;
      taken_back += now < worst ? 1 : 0;
      worst = std::max(worst, now);
      before = now;
    }
    errors += worst == HealthLevel::kError ? 1 : 0;
  }
  EXPECT_LE(taken_back, 3);
  EXPECT_EQ(errors, 15);
}

// Neither trend may carry a small step on into a large one: by 3 % at most, and the line itself overshoots by a
// seventh.
TEST(Health, ASmallStepDoesNotLookLarge) {
  for (const auto& [left, level] : {std::pair(0.92, HealthLevel::kOk), std::pair(0.8, HealthLevel::kWarn)})
    for (int seed = 1; seed <= 5; ++seed) {
      SimulationOptions drive;
      drive.seed = seed;
      drive.ramp_start = 60.0;
      drive.ramp_end = 60.02;
      drive.damping_end_fraction = left;
      const FirstAlarms first = firstAlarms(simulate(drive), judgedOptions());
      EXPECT_EQ(first.warn.has_value(), level == HealthLevel::kWarn) << left << ' ' << seed;
      EXPECT_FALSE(first.error) << left << ' ' << seed;
    }
}

// One hour; the whole day is in the benchmark. The clean drive is repeated with fresh noise; once a minute both
// readings are 0 for a second, and once a minute a bump hits the stops, which adds a pulse to the body's reading.
TEST(Health, HealthyDriveWithOutliersAndBumpsNeverWarns) {
  constexpr int kPeriods = 60;
  constexpr double kNoise = 0.024;
  const std::vector<CornerSample> clean = healthyPaperDrive(60.0, 0.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-kNoise * std::sqrt(3.0), kNoise * std::sqrt(3.0));
  SuspensionMonitor monitor(judgedOptions());
  Stamp stamp{};
  int early = 0;
  for (int period = 0; period < kPeriods; ++period)
    for (std::size_t k = 0; k + 1 < clean.size(); ++k, stamp += fromSeconds(0.02)) {
      CornerSample sample = clean[k];
      sample.stamp = stamp;
      sample.sprung_acceleration += noise(random);
      sample.unsprung_acceleration += noise(random);
      if (k >= 1250 && k < 1300) sample.sprung_acceleration = sample.unsprung_acceleration = 0.0;
      if (k >= 2500 && k < 2505) sample.sprung_acceleration += 10.0;
      const MonitorReport* report = monitor.addSample(sample);
      ASSERT_NE(report, nullptr);
      ASSERT_NE(report->health.level, HealthLevel::kError) << "at " << toSeconds(stamp) << describe(report->health);
      ASSERT_NE(report->health.level, HealthLevel::kWarn) << "at " << toSeconds(stamp) << describe(report->health);
      early += report->health.early_warning ? 1 : 0;
    }
  EXPECT_EQ(early, 0);
}

TEST(Health, LearnsTheBaselineAndJudgesByIt) {
  MonitorSettings options = liveOptions();
  options.learn_time = 30.0;
  SimulationOptions drive;
  drive.ramp_start = 60.0;
  drive.ramp_end = 60.02;
  SuspensionMonitor monitor(options);
  for (const CornerSample& sample : simulate(drive)) {
    monitor.addSample(sample);
    const double t = toSeconds(sample.stamp);
    if (t > 5.0 && t < 30.0) {
      ASSERT_TRUE(monitor.report().health.learning) << t;
      ASSERT_FALSE(monitor.report().health.damping_change) << t;
    }
  }
  EXPECT_NEAR(*monitor.baseline().damping_to_mass, kPaperB1, 0.06);
  EXPECT_NEAR(*monitor.baseline().stiffness_to_mass, kPaperB0, 0.2);
  EXPECT_EQ(monitor.report().health.level, HealthLevel::kError);
  EXPECT_NEAR(*monitor.report().health.damping_change, -1.0 / 3.0, 0.03);
  EXPECT_NE(describe(monitor.report().health).find("below baseline"), std::string::npos);
}

TEST(Health, DoesNotLearnAStrutThatIsWearingOut) {
  MonitorSettings options = liveOptions();
  options.learn_time = 50.0;
  SimulationOptions drive;
  drive.ramp_start = 2.0;
  drive.ramp_end = 100.0;
  drive.duration = 90.0;
  SuspensionMonitor monitor(options);
  for (const CornerSample& sample : simulate(drive)) monitor.addSample(sample);
  EXPECT_TRUE(monitor.report().health.learning_restarted);
  EXPECT_TRUE(monitor.baseline().isEmpty());
}

TEST(Health, TellsPayloadFromWear) {
  SimulationOptions loaded;
  loaded.damping_end_fraction = 1.0;
  loaded.duration = 60.0;
  loaded.damping_to_mass = kPaperB1 / 1.3;
  loaded.stiffness_to_mass = kPaperB0 / 1.3;
  const HealthReport payload = healthAfter(simulate(loaded), judgedOptions());
  EXPECT_EQ(payload.level, HealthLevel::kOk) << describe(payload);
  EXPECT_NEAR(*payload.payload_change, 0.3, 0.04);
  loaded.damping_to_mass = 0.6 * *loaded.damping_to_mass;
  const HealthReport both = healthAfter(simulate(loaded), judgedOptions());
  EXPECT_EQ(both.damping_level, HealthLevel::kError) << describe(both);
  EXPECT_EQ(both.stiffness_level, HealthLevel::kOk) << describe(both);
  EXPECT_NEAR(*both.damping_change, -0.4, 0.05);
  MonitorSettings no_payload = judgedOptions();
  no_payload.payload_range = 0.0;
  loaded.damping_to_mass = kPaperB1 / 1.3;
  EXPECT_EQ(healthAfter(simulate(loaded), no_payload).level, HealthLevel::kWarn);
}

TEST(Health, SaysThatOutliersArePresent) {
  std::vector<CornerSample> drive = healthyPaperDrive(120.0, 0.024);
  EXPECT_FALSE(healthAfter(drive, judgedOptions()).outliers);
  for (std::size_t k = 1500; k < drive.size(); ++k)
    if (k % 500 < 5) drive[k].sprung_acceleration += 5.0;
  const HealthReport report = healthAfter(drive, judgedOptions());
  EXPECT_TRUE(report.outliers) << describe(report);
}

std::vector<CornerSample> withGravity(std::vector<CornerSample> drive, double sprung_gain, double sprung_bias) {
  for (CornerSample& sample : drive) {
    sample.sprung_acceleration = sprung_gain * (sample.sprung_acceleration + 9.81) + sprung_bias;
    sample.unsprung_acceleration += 9.81;
  }
  return drive;
}

// The estimate takes out an offset, and fits the gain.
TEST(Health, TellsASensorFaultFromADamper) {
  const std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  for (const auto& [gain, bias] : {std::pair(1.0, 0.0), std::pair(1.0, 2.0), std::pair(0.7, 0.0)}) {
    const HealthReport report = healthAfter(withGravity(drive, gain, bias), judgedOptions());
    EXPECT_EQ(report.sensor.fault, gain == 1.0 ? SensorFault::kNone : SensorFault::kGainsDiffer) << describe(report);
    EXPECT_EQ(report.level, gain == 1.0 ? HealthLevel::kOk : HealthLevel::kWarn) << describe(report);
    EXPECT_LT(std::abs(*report.damping_change), 0.1) << describe(report);
  }
}

TEST(Health, NamesTheSensorThatIsStuck) {
  const std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  for (const bool sprung : {true, false}) {
    std::vector<CornerSample> stuck = drive;
    for (std::size_t k = 1500; k < stuck.size(); ++k)
      (sprung ? stuck[k].sprung_acceleration : stuck[k].unsprung_acceleration) = 0.3;
    EXPECT_EQ(healthAfter(stuck, judgedOptions()).sensor.fault,
              sprung ? SensorFault::kSprungStuck : SensorFault::kUnsprungStuck);
  }
}

TEST(Health, SaysWhenTheReadingsDoNotBelongTogether) {
  std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  SimulationOptions other;
  other.scenario = "iso_road";
  other.vehicle = "rover";
  other.duration = 60.0;
  const std::vector<CornerSample> elsewhere = simulate(other);
  for (std::size_t k = 0; k < drive.size(); ++k) drive[k].sprung_acceleration = elsewhere[k].sprung_acceleration;
  const HealthReport report = healthAfter(drive, judgedOptions());
  EXPECT_EQ(report.sensor.fault, SensorFault::kUnrelated) << describe(report);
  EXPECT_EQ(report.level, HealthLevel::kStale);
}

// Noise alone, of a parked vehicle, is no motion that a strut would have to explain.
TEST(Health, AParkedVehicleHasNoSensorFault) {
  std::vector<CornerSample> drive = healthyPaperDrive(90.0, 0.024);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.024);
  for (std::size_t k = 1500; k < drive.size(); ++k) {
    drive[k].sprung_acceleration = noise(random);
    drive[k].unsprung_acceleration = noise(random);
  }
  EXPECT_EQ(healthAfter(drive, judgedOptions()).sensor.fault, SensorFault::kNone);
}

}  // namespace
}  // namespace suspension_health_monitor
