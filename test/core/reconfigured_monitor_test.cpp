#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

void feed(SuspensionMonitor& monitor, const std::vector<CornerSample>& samples, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) monitor.addSample(samples[i]);
}

/// Row i of n1 + n2, of which the last n2 came with another factor, is forgotten by each factor in its time.
TEST(ReconfiguredMonitor, LeastSquaresWeighsRowsByTheFactorThatHeldInTheirTime) {
  const std::vector<RegressionRow> rows = strutRows(healthyPaperDrive(20.0, 0.024), liveOptions().filter(0.02));
  const std::size_t changed_at = 500, end = 650;
  RecursiveOptions recursive = liveOptions().recursive(0);
  recursive.drifting_offset = false;
  recursive.forgetting_factor = 0.98;
  const double later = 0.995;
  RecursiveLeastSquares estimator(2, recursive);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(2, 2);
  Eigen::VectorXd moment = Eigen::VectorXd::Zero(2);
  double weights = 0.0;
  for (std::size_t i = 0; i < end; ++i) {
    if (i == changed_at) estimator.setForgettingFactor(later);
    const double factor = i < changed_at ? recursive.forgetting_factor : later;
    gram = factor * gram + rows[i].regressor * rows[i].regressor.transpose();
    moment = factor * moment + rows[i].regressor * rows[i].output;
    weights = factor * weights + 1.0;
    estimator.update(rows[i]);
  }
  const Eigen::VectorXd expected = gram.ldlt().solve(moment);
  EXPECT_NEAR(estimator.parameters()[0], expected[0], 1e-6);
  EXPECT_NEAR(estimator.parameters()[1], expected[1], 1e-5);
  EXPECT_NEAR(estimator.effectiveRows(), weights, 1e-9);
  EXPECT_EQ(estimator.forgettingFactor(), later);
}

TEST(ReconfiguredMonitor, EstimatesGoOnFromWhereTheyAre) {
  const std::vector<CornerSample> samples = healthyPaperDrive(60.0, 0.024);
  SuspensionMonitor monitor(liveOptions()), left_alone(liveOptions());
  feed(monitor, samples, 0, 1500);
  feed(left_alone, samples, 0, 1501);
  MonitorSettings options = monitor.options();
  options.forgetting_factor = 0.998;
  monitor.reconfigure(options);
  const MonitorReport* after = monitor.addSample(samples[1500]);
  ASSERT_NE(after, nullptr);
  EXPECT_TRUE(after->ls.valid() && after->la.valid());
  // The first row after the change has a gain that differs by no more than the factors do, 0.8 %.
  const StrutEstimate& la = left_alone.report().la;
  EXPECT_NEAR(after->la.damping_to_mass, la.damping_to_mass, 0.01 * la.damping_to_mass_stddev);
  EXPECT_EQ(monitor.input().gaps, 0u);
  feed(monitor, samples, 1501, samples.size());
  EXPECT_GT(monitor.report().la.effective_rows, 400.0);
  EXPECT_NEAR(monitor.report().la.damping_to_mass, kPaperB1, 0.1);
}

// A memory that was longer counts for a while.
TEST(ReconfiguredMonitor, StandardDeviationsAreNumbersAfterAShorterMemoryIsSet) {
  const std::vector<CornerSample> samples = healthyPaperDrive(60.0, 0.024);
  MonitorSettings options = liveOptions();
  options.forgetting_factor = 0.998;
  SuspensionMonitor monitor(options);
  feed(monitor, samples, 0, 2500);
  options.forgetting_factor = 0.98;
  monitor.reconfigure(options);
  for (std::size_t k = 2500; k < samples.size(); ++k) {
    monitor.addSample(samples[k]);
    ASSERT_TRUE(monitor.report().la.valid()) << toSeconds(samples[k].stamp);
    ASSERT_GT(monitor.report().ls.damping_to_mass_stddev, 0.0);
  }
}

TEST(ReconfiguredMonitor, TheSameOptionsChangeNothing) {
  const std::vector<CornerSample> samples = healthyPaperDrive(20.0, 0.024);
  SuspensionMonitor left_alone(liveOptions()), reconfigured(liveOptions());
  for (const CornerSample& sample : samples) {
    left_alone.addSample(sample);
    reconfigured.reconfigure(reconfigured.options());
    reconfigured.addSample(sample);
  }
  EXPECT_EQ(reconfigured.report().la.damping_to_mass, left_alone.report().la.damping_to_mass);
  EXPECT_EQ(reconfigured.report().ls.stiffness_to_mass_stddev, left_alone.report().ls.stiffness_to_mass_stddev);
}

TEST(ReconfiguredMonitor, ThresholdsHoldAtOnceAndImpossibleOnesAreRefused) {
  MonitorSettings options = liveOptions();
  options.nominal_damping_to_mass = kPaperB1 / 0.75;
  options.nominal_stiffness_to_mass = kPaperB0;
  options.damping_error = 0.5;
  SuspensionMonitor monitor(options);
  const std::vector<CornerSample> samples = healthyPaperDrive(40.0, 0.001);
  feed(monitor, samples, 0, 1000);
  EXPECT_EQ(monitor.report().health.level, HealthLevel::kWarn);
  options.damping_error = 0.1;
  EXPECT_THROW(monitor.reconfigure(options), std::invalid_argument);
  EXPECT_EQ(monitor.options().damping_error, 0.5);
  feed(monitor, samples, 1000, 1200);
  EXPECT_EQ(monitor.report().health.level, HealthLevel::kWarn);
  options.damping_error = 0.2;
  monitor.reconfigure(options);
  feed(monitor, samples, 1200, 1300);
  EXPECT_EQ(monitor.report().health.level, HealthLevel::kError);
}

}  // namespace
}  // namespace suspension_health_monitor
