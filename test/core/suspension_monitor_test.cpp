#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "monitor_settings.h"
#include "paper_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr Stamp kPeriod = std::chrono::milliseconds(20);
constexpr int kRowsLost = 84;  // 2 L + 24

void addAll(SuspensionMonitor& monitor, const std::vector<CornerSample>& samples) {
  for (const CornerSample& sample : samples) monitor.addSample(sample);
}

std::vector<CornerSample> later(std::vector<CornerSample> samples, Stamp by) {
  for (CornerSample& sample : samples) sample.stamp += by;
  return samples;
}

void expectSameParameters(const StrutEstimate& a, const StrutEstimate& b) {
  EXPECT_EQ(a.damping_to_mass, b.damping_to_mass);
  EXPECT_EQ(a.stiffness_to_mass, b.stiffness_to_mass);
}

// As long as every row counts: a second of zeros may be held for rest, a drive without it is not.
TEST(SuspensionMonitor, AddsNothingToFilterAndEstimators) {
  MonitorSettings exponential = liveOptions();
  exponential.forgets_unexcited = true;
  MonitorSettings live = liveOptions();
  live.estimators.drifting_offset = exponential.estimators.drifting_offset = false;
  const std::vector<std::pair<MonitorSettings, const char*>> cases{
      {exponential, "paper_outliers"}, {paperOptions(), "paper_outliers"}, {live, "paper_clean"}};
  for (const auto& [options, scenario] : cases) {
    SimulationOptions drive;
    drive.scenario = scenario;
    drive.duration = 60.0;
    SuspensionMonitor monitor(options);
    SuspensionRegression regression(options.filter(0.02));
    RecursiveLeastSquares ls(kNumStrutParameters, options.recursive(0));
    RecursiveLeastAbsolute la(kNumStrutParameters, options.recursive(0));
    for (const CornerSample& sample : simulate(drive)) {
      const MonitorReport& report = *monitor.addSample(sample);
      const RegressionRow* row = regression.push(sample);
      ASSERT_EQ(report.has_row, row != nullptr);
      if (row == nullptr) continue;
      ls.update(*row);
      la.update(*row);
      ASSERT_EQ(report.ls.damping_to_mass, ls.parameters()[0]);
      ASSERT_EQ(report.ls.stiffness_to_mass, ls.parameters()[1]);
      ASSERT_EQ(report.la.damping_to_mass, la.parameters()[0]);
      ASSERT_EQ(report.la.stiffness_to_mass, la.parameters()[1]);
      ASSERT_EQ(report.ls.effective_rows, ls.effectiveRows());
    }
  }
}

// Readings of the wheel that are two samples ahead: rows over a short horizon fit a strut that the free run is not.
// Near 0 the figure, which weighs large errors most, and the count of samples that a constant fits better may differ.
TEST(SuspensionMonitor, AnEstimateWhoseFreeRunFailsIsNotValidAtAnySample) {
  SimulationOptions drive;
  drive.scenario = "iso_road";
  drive.vehicle = "ugv";
  drive.rate = 100.0;
  const std::vector<CornerSample> samples = simulate(drive);
  MonitorSettings options = paperOptions();
  options.sample_period = 0.01;
  options.integration_horizon = 0.1;
  SuspensionMonitor monitor(options);
  int failed = 0;
  for (std::size_t k = 0; k + 2 < samples.size(); ++k) {
    const MonitorReport& report =
        *monitor.addSample({samples[k].stamp, samples[k].sprung_acceleration, samples[k + 2].unsprung_acceleration});
    if (toSeconds(samples[k].stamp - samples[0].stamp) < 30.0 || !(report.comparison.fit_percent < -15.0)) continue;
    EXPECT_FALSE(report.la.valid()) << k;
    failed += report.la.doubt == EstimateDoubt::kFreeRunFails ? 1 : 0;
  }
  EXPECT_GT(failed, 1000);
}

TEST(SuspensionMonitor, ComparesTheFreeRunOfTheEstimateWithTheBody) {
  SuspensionMonitor monitor(liveOptions());
  FreeRun free_run(0.02);
  bool has_model = false;
  const std::vector<CornerSample> drive = healthyPaperDrive(30.0, 0.024);
  for (std::size_t k = 0; k < drive.size(); ++k) {
    const std::optional<double> predicted = free_run.push(drive[k].unsprung_acceleration);
    const MonitorReport& report = *monitor.addSample(drive[k]);
    ASSERT_EQ(report.comparison.predicted.has_value(), predicted && free_run.settled());
    if (report.comparison.predicted) {
      ASSERT_EQ(report.comparison.predicted, predicted);
    }
    if (k % 8 == 0 || !has_model) {  // it gets a new model every eighth sample
      const bool la_leads = std::isnan(report.estimate.age) && report.has_row && report.la.effective_rows >= 50.0;
      if (report.estimate.valid() || la_leads) {
        const StrutEstimate& of = report.estimate.valid() ? report.estimate : report.la;
        EXPECT_TRUE(free_run.trySetModel(of.damping_to_mass, of.stiffness_to_mass));
        has_model = true;
      }
    }
    ASSERT_EQ(report.measured, drive[k].sprung_acceleration);
    ASSERT_EQ(report.comparison.has_sample, k >= FreeRun::kDelay);
    if (k < FreeRun::kDelay) continue;
    const CornerSample& compared = drive[k - FreeRun::kDelay];
    ASSERT_EQ(report.comparison.stamp, compared.stamp);
    ASSERT_EQ(report.comparison.measured, compared.sprung_acceleration);
  }
  // Noise 0.024 of the body's sensor, and of the wheel's through model and parameters: about 1.0 to 1.1 of it. The rms
  // of the 500 samples of the window scatters by 3 %.
  EXPECT_GT(monitor.report().comparison.rmse, 0.9 * 0.024);
  EXPECT_LT(monitor.report().comparison.rmse, 1.2 * 0.024);
  EXPECT_EQ(monitor.report().comparison.base_rmse, monitor.report().comparison.rmse);
  EXPECT_EQ(monitor.report().comparison.base_fit_percent, monitor.report().comparison.fit_percent);
}

TEST(SuspensionMonitor, ComesCloseToTheTruthAndKnowsHowClose) {
  SuspensionMonitor monitor(liveOptions());
  addAll(monitor, healthyPaperDrive(60.0, 0.024));
  const StrutEstimate& blocks = monitor.report().estimate;
  EXPECT_TRUE(blocks.valid());
  EXPECT_NEAR(blocks.damping_to_mass, kPaperB1, 3.0 * blocks.damping_to_mass_stddev);
  EXPECT_NEAR(blocks.stiffness_to_mass, kPaperB0, 3.0 * blocks.stiffness_to_mass_stddev);
  EXPECT_LT(blocks.damping_to_mass_stddev, 0.0375 * kPaperB1);  // what a window needs to be long enough
  EXPECT_LT(blocks.stiffness_to_mass_stddev, 0.0375 * kPaperB0);
  EXPECT_GT(blocks.explained, 0.99);
  for (const StrutEstimate& estimate : {monitor.report().ls, monitor.report().la}) {
    EXPECT_TRUE(estimate.valid());
    EXPECT_NEAR(estimate.damping_to_mass, kPaperB1, 0.15);
    EXPECT_NEAR(estimate.stiffness_to_mass, kPaperB0, 0.4);
    // Neighbouring rows share most of their noise, so white residuals promise too much, but not by an order.
    EXPECT_GT(estimate.damping_to_mass_stddev, 0.15 / 30);
    EXPECT_LT(estimate.damping_to_mass_stddev, 0.15);
    EXPECT_NEAR(estimate.effective_rows, 100.0, 1e-6);
    EXPECT_GT(estimate.explained, 0.9);
  }
}

TEST(SuspensionMonitor, BecomesValidWithThreeBlocksWhichOverlapByHalf) {
  SuspensionMonitor monitor(liveOptions());
  for (const CornerSample& sample : healthyPaperDrive(10.0, 0.001)) {
    const MonitorReport& report = *monitor.addSample(sample);
    const double time = toSeconds(sample.stamp);
    ASSERT_EQ(report.estimate.valid(), time >= 4.0) << time;  // the first reading behind the third block
    ASSERT_EQ(report.la.valid(), time >= 4.0) << time;
    ASSERT_EQ(report.ls.valid(), time >= 4.0) << time;
  }
}

TEST(SuspensionMonitor, OfThePaperIsValidWhenTheMemoryHoldsEnoughRows) {
  SuspensionMonitor monitor(paperOptions());
  int rows = 0;
  for (const CornerSample& sample : healthyPaperDrive(10.0, 0.001)) {
    const MonitorReport& report = *monitor.addSample(sample);
    if (report.has_row) ++rows;
    // (1 - 0.98^n) / 0.02 >= 45, nine tenths of the memory, from n = 114 on.
    ASSERT_EQ(report.la.valid(), rows >= 114) << rows;
  }
}

TEST(SuspensionMonitor, GapEmptiesTheFilterAndHoldsTheEstimatesAsNotValid) {
  SuspensionMonitor monitor(liveOptions());
  const std::vector<CornerSample> drive = healthyPaperDrive(20.0, 0.024);
  addAll(monitor, drive);
  const StrutEstimate before = monitor.report().la;
  ASSERT_TRUE(before.valid());
  const std::uint64_t rows_before = monitor.input().rows;
  int since_gap = 0;
  for (const CornerSample& sample : later(drive, drive.back().stamp + 2 * kPeriod)) {
    const MonitorReport& report = *monitor.addSample(sample);
    ++since_gap;
    ASSERT_EQ(report.has_row, since_gap > kRowsLost);
    if (report.has_row) continue;
    expectSameParameters(report.la, before);
    ASSERT_TRUE(report.estimate.valid());
    ASSERT_FALSE(report.la.valid());
    ASSERT_FALSE(report.ls.valid());
    ASSERT_FALSE(report.comparison.predicted);
  }
  EXPECT_TRUE(monitor.report().la.valid());
  EXPECT_EQ(monitor.input().gaps, 1u);
  EXPECT_EQ(monitor.input().restarts, 0u);
  EXPECT_EQ(monitor.input().rows - rows_before, drive.size() - kRowsLost);
}

TEST(SuspensionMonitor, OneMissingSampleIsAGapAndJitterIsNone) {
  SuspensionMonitor monitor(liveOptions());
  for (const int milliseconds : {0, 20, 49, 60, 80}) monitor.addSample({std::chrono::milliseconds(milliseconds), 1, 2});
  EXPECT_EQ(monitor.input().gaps, 0u);
  monitor.addSample({std::chrono::milliseconds(110), 1, 2});
  EXPECT_EQ(monitor.input().gaps, 1u);
  EXPECT_NEAR(monitor.input().mean_period, 0.02, 1e-3);  // the gap is not in it
}

TEST(SuspensionMonitor, RejectsAndCountsSamplesThatComeTooSoon) {
  SuspensionMonitor monitor(liveOptions()), undisturbed(liveOptions());
  for (const CornerSample& sample : healthyPaperDrive(10.0, 0.024)) {
    ASSERT_NE(monitor.addSample(sample), nullptr);
    undisturbed.addSample(sample);
    CornerSample soon = sample;
    soon.stamp += kPeriod / 2;
    soon.sprung_acceleration = 77.0;
    ASSERT_EQ(monitor.addSample(soon), nullptr);
  }
  EXPECT_EQ(monitor.rejected().count(RejectReason::kTooSoon), 501u);
  EXPECT_EQ(monitor.rejected().total(), 501u);
  EXPECT_EQ(monitor.input().samples, 501u);
  expectSameParameters(monitor.report().la, undisturbed.report().la);
}

TEST(SuspensionMonitor, RejectsAndCountsWhatIsNoNumber) {
  SuspensionMonitor monitor(liveOptions());
  const std::vector<CornerSample> drive = healthyPaperDrive(10.0, 0.024);
  addAll(monitor, drive);
  const StrutEstimate before = monitor.report().la;
  const Stamp next = drive.back().stamp + kPeriod;
  EXPECT_EQ(monitor.addSample({next, std::nan(""), 1.0}), nullptr);
  EXPECT_EQ(monitor.addSample({next, 1.0, -std::numeric_limits<double>::infinity()}), nullptr);
  EXPECT_EQ(monitor.addSample({next, 1e200, 1.0}), nullptr);  // its square is infinite
  EXPECT_EQ(monitor.rejected().count(RejectReason::kNotFinite), 3u);
  EXPECT_EQ(monitor.input().samples, drive.size());
  expectSameParameters(monitor.report().la, before);
  addAll(monitor, later(drive, next));  // the same stamp is still free
  EXPECT_EQ(monitor.input().gaps, 0u);
  EXPECT_TRUE(monitor.report().la.valid());
}

TEST(SuspensionMonitor, SurvivesTheLargestReadingThatItTakes) {
  SuspensionMonitor monitor(liveOptions());
  const std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  addAll(monitor, drive);
  const Stamp next = drive.back().stamp + kPeriod;
  ASSERT_NE(monitor.addSample({next, 0.99e60, -0.99e60}), nullptr);
  for (int pass = 0; pass < 60; ++pass)
    addAll(monitor, later(drive, next + kPeriod + pass * (drive.back().stamp + kPeriod)));
  EXPECT_TRUE(std::isfinite(monitor.report().ls.damping_to_mass));
  EXPECT_TRUE(std::isfinite(monitor.report().la.damping_to_mass_stddev));
  EXPECT_TRUE(monitor.report().la.valid());
}

TEST(SuspensionMonitor, ClockThatGoesBackStartsANewSeriesAndKeepsWhatWasLearnt) {
  SuspensionMonitor monitor(liveOptions());
  const std::vector<CornerSample> drive = healthyPaperDrive(20.0, 0.024);
  addAll(monitor, drive);
  const StrutEstimate before = monitor.report().la;
  const MonitorReport& report = *monitor.addSample(drive.front());
  EXPECT_EQ(monitor.input().restarts, 1u);
  EXPECT_EQ(monitor.input().gaps, 0u);
  EXPECT_FALSE(report.has_row);
  EXPECT_FALSE(report.la.valid());
  EXPECT_FALSE(report.estimate.valid());
  EXPECT_EQ(report.stamp, drive.front().stamp);
  expectSameParameters(report.la, before);
  addAll(monitor, drive);
  EXPECT_TRUE(monitor.report().la.valid());
  EXPECT_NEAR(monitor.report().la.stiffness_to_mass, kPaperB0, 0.4);
}

TEST(SuspensionMonitor, StampsNeedNoCommonOriginWithTheUnixEpoch) {
  SuspensionMonitor early(liveOptions()), today(liveOptions());
  const std::vector<CornerSample> drive = healthyPaperDrive(10.0, 0.024);
  addAll(early, drive);
  addAll(today, later(drive, std::chrono::seconds(1754000000)));
  expectSameParameters(early.report().la, today.report().la);
  EXPECT_EQ(today.input().rows, early.input().rows);
}

TEST(SuspensionMonitor, WarnsOfAWornDamper) {
  MonitorSettings options = liveOptions();
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  SuspensionMonitor monitor(options);
  SimulationOptions worn;
  worn.duration = 30.0;
  worn.damping_end_fraction = 1.0;
  worn.damping_to_mass = 0.6 * kPaperB1;
  addAll(monitor, simulate(worn));
  EXPECT_EQ(monitor.report().health.level, HealthLevel::kError);
  EXPECT_EQ(monitor.report().health.stiffness_level, HealthLevel::kOk);
  EXPECT_NEAR(*monitor.report().health.damping_change, -0.4, 0.05);
}

}  // namespace
}  // namespace suspension_health_monitor
