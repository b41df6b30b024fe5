#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

MonitorSettings optionsAt(double sample_period) {
  MonitorSettings options = liveOptions();
  options.sample_period = sample_period;
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  return options;
}

// The paper's drive comes every 0.02 s. A period of 0.02 (1 + e) reads b1 as b1 / (1 + e), a healthy damper as worn,
// for all but the blocks, which count by stamps.
TEST(WrongPeriod, LeavesLeastSquaresNotValidAndTheEstimateRight) {
  const std::vector<CornerSample> drive = healthyPaperDrive(40.0, 0.024);
  for (const double error : {-0.25, -0.03, 0.03, 0.1, 0.4, 0.8}) {
    SCOPED_TRACE(error);
    SuspensionMonitor monitor(optionsAt(0.02 * (1.0 + error)));
    for (const CornerSample& sample : drive) {
      const MonitorReport& report = *monitor.addSample(sample);
      ASSERT_FALSE(report.la.valid() || report.ls.valid());
      ASSERT_NE(report.health.level, HealthLevel::kWarn);
      ASSERT_NE(report.health.level, HealthLevel::kError);
    }
    EXPECT_FALSE(monitor.input().period_fits);
    EXPECT_NEAR(monitor.report().la.damping_to_mass * (1.0 + error), kPaperB1, 0.2) << "else it would not matter";
    EXPECT_EQ(monitor.report().la.doubt, EstimateDoubt::kWrongPeriod);
    EXPECT_TRUE(monitor.report().estimate.valid());
    EXPECT_NEAR(monitor.report().estimate.damping_to_mass, kPaperB1, 0.1 * kPaperB1);
    EXPECT_NEAR(monitor.report().estimate.stiffness_to_mass, kPaperB0, 0.05 * kPaperB0);
    EXPECT_EQ(monitor.report().health.level, HealthLevel::kOk);
  }
}

TEST(WrongPeriod, ASmallErrorAndJitterAreNone) {
  std::vector<CornerSample> drive = healthyPaperDrive(40.0, 0.024);
  for (const double error : {-0.015, 0.0, 0.015}) {
    SuspensionMonitor monitor(optionsAt(0.02 * (1.0 + error)));
    for (std::size_t k = 0; k < drive.size(); ++k) {
      CornerSample sample = drive[k];
      sample.stamp += std::chrono::milliseconds(k % 2 == 0 ? -2 : 2);
      monitor.addSample(sample);
      ASSERT_TRUE(monitor.input().period_fits) << k;
    }
    EXPECT_TRUE(monitor.report().la.valid());
  }
}

TEST(WrongPeriod, IsForgottenWhenTheStampsFitAgain) {
  SuspensionMonitor monitor(optionsAt(0.02));
  Stamp stamp{};
  const auto drive = healthyPaperDrive(100.0, 0.024);
  for (std::size_t k = 0; k < drive.size(); ++k) {
    stamp += std::chrono::microseconds(k < 1000 ? 22000 : 20000);
    monitor.addSample({stamp, drive[k].sprung_acceleration, drive[k].unsprung_acceleration});
    if (k == 999) {
      ASSERT_FALSE(monitor.input().period_fits);
    }
  }
  EXPECT_TRUE(monitor.input().period_fits);
  EXPECT_TRUE(monitor.report().la.valid());
}

TEST(WrongPeriod, SurvivesAnotherForgettingFactor) {
  SuspensionMonitor monitor(optionsAt(0.022));
  const auto drive = healthyPaperDrive(20.0, 0.024);
  for (std::size_t k = 0; k < drive.size(); ++k) {
    if (k == 900) {
      MonitorSettings other = monitor.options();
      other.forgetting_factor = 0.98;
      monitor.reconfigure(other);
    }
    ASSERT_FALSE(monitor.addSample(drive[k])->la.valid()) << k;
  }
}

TEST(WrongPeriod, LeavesNoTyreValid) {
  SimulationOptions drive;
  drive.scenario = "iso_road";
  drive.vehicle = "ugv";
  drive.rate = 200.0;
  drive.duration = 30.0;
  MonitorSettings options;
  options.sample_period = 1.0 / drive.rate;
  for (const bool fits : {true, false}) {
    TyreTracker tyre(options);
    tyre.setPeriodFits(fits);
    DriveSimulator simulator(drive);
    while (const auto sample = simulator.next())
      tyre.add({sample->stamp, sample->sprung->acceleration, sample->unsprung->acceleration},
               sample->road->acceleration);
    EXPECT_EQ(tyre.report().la.valid(), fits);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
