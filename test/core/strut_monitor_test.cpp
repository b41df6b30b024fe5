// The public class of the live path: the same reports as its parts give, and nothing that only a part would tell.
#include "suspension_health_monitor/strut_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.02, kDamping = 3.0, kStiffness = 13.8;

/// A strut driven by noise at its wheel, gravity in both readings; exact for the zero-order hold of 1 ms.
std::vector<CornerSample> drive(int samples) {
  std::mt19937 engine(3);
  std::normal_distribution<double> push(0.0, 3.0);
  std::vector<CornerSample> drive;
  double travel = 0.0, rate = 0.0, wheel = 0.0;
  for (int i = 0; i < samples; ++i) {
    for (int step = 0; step < 20; ++step) {
      wheel += 0.02 * (push(engine) * 10.0 - wheel);
      const double body = kDamping * rate + kStiffness * travel;
      rate += 0.001 * (wheel - body);
      travel += 0.001 * rate;
    }
    drive.push_back({fromSeconds(100.0 + i * kPeriod), 9.81 + kDamping * rate + kStiffness * travel, 9.81 + wheel});
  }
  return drive;
}

void push(StrutMonitor& monitor, const CornerSample& sample) {
  monitor.push(Side::kUnsprung, sample.stamp, sample.unsprung_acceleration);
  monitor.push(Side::kSprung, sample.stamp, sample.sprung_acceleration);
}

MonitorOptions withPeriod() {
  MonitorOptions options;
  options.sample_period = kPeriod;
  options.alignment = "paired";
  return options;
}

TEST(StrutMonitor, KnowsNoErrorOfWhatItDoesNotKnow) {
  StrutMonitor monitor(withPeriod());
  bool was_known = false;
  int rows = 0;
  for (const CornerSample& sample : drive(1500)) {
    push(monitor, sample);
    rows += monitor.report().has_row;
    for (const StrutEstimate& estimate : {monitor.report().estimate, monitor.report().ls, monitor.report().la})
      for (const auto& [value, stddev] : {std::pair(estimate.damping_to_mass, estimate.damping_to_mass_stddev),
                                          std::pair(estimate.stiffness_to_mass, estimate.stiffness_to_mass_stddev)}) {
        ASSERT_TRUE(std::isnan(stddev) || (std::isfinite(value) && stddev > 0.0)) << value << " +- " << stddev;
        was_known = was_known || stddev > 0.0;
      }
  }
  EXPECT_TRUE(was_known);
  EXPECT_GT(rows, 1000);
}

TEST(StrutMonitor, ReportsWhatItsPartsReport) {
  int reports = 0;
  StrutMonitor monitor(withPeriod(), [&](const MonitorReport&) { ++reports; });
  SuspensionMonitor parts(withPeriod());
  for (const CornerSample& sample : drive(3000)) {
    push(monitor, sample);
    parts.addSample(sample);
  }
  EXPECT_EQ(reports, 3000);
  EXPECT_TRUE(monitor.report().estimate.valid());
  EXPECT_EQ(monitor.report().estimate.damping_to_mass, parts.report().estimate.damping_to_mass);
  EXPECT_EQ(monitor.report().la.damping_to_mass, parts.report().la.damping_to_mass);
  EXPECT_EQ(monitor.report().ls.stiffness_to_mass, parts.report().ls.stiffness_to_mass);
  EXPECT_EQ(monitor.input().rows, parts.input().rows);
}

TEST(StrutMonitor, MeasuresTheSamplePeriodAndMoves) {
  StrutMonitor first;
  EXPECT_FALSE(first.samplePeriod());
  EXPECT_FALSE(first.report().la.valid());
  std::vector<CornerSample> samples = drive(3000);
  for (std::size_t i = 0; i < 500; ++i) push(first, samples[i]);
  StrutMonitor monitor = std::move(first);
  for (std::size_t i = 500; i < samples.size(); ++i) push(monitor, samples[i]);
  ASSERT_TRUE(monitor.samplePeriod());
  EXPECT_NEAR(*monitor.samplePeriod(), kPeriod, 1e-9);
  EXPECT_EQ(monitor.input().samples, 3000U);
  EXPECT_NEAR(monitor.report().la.damping_to_mass, kDamping, 0.1 * kDamping);
  EXPECT_NEAR(monitor.report().estimate.damping_to_mass, kDamping, 0.1 * kDamping);
  EXPECT_TRUE(monitor.rejected().empty());
}

TEST(StrutMonitor, CountsWhatItKeepsOut) {
  StrutMonitor monitor(withPeriod());
  std::vector<CornerSample> samples = drive(200);
  samples[100].sprung_acceleration = std::numeric_limits<double>::quiet_NaN();
  for (const CornerSample& sample : samples) push(monitor, sample);
  EXPECT_EQ(monitor.rejected().at("not_finite"), 1U);
  EXPECT_EQ(monitor.input().gaps, 1U);
}

TEST(StrutMonitor, RefusesWrongOptions) {
  MonitorOptions options = withPeriod();
  options.alignment = "guessed";
  EXPECT_THROW(StrutMonitor{options}, std::invalid_argument);
  options = withPeriod();
  options.forgetting_factor = 2.0;
  EXPECT_THROW(StrutMonitor{options}, std::invalid_argument);
}

TEST(StrutMonitor, RefusesWrongEffectsAndBaselinesAtOnce) {
  StrutMonitor monitor;  // whose period is not known yet
  Baseline healthy;
  healthy.damping_to_mass = kDamping;
  monitor.setBaseline(healthy);
  EXPECT_EQ(monitor.baseline().damping_to_mass, kDamping);
  EXPECT_THROW(monitor.setEffects({ActiveEffect{}}), std::invalid_argument);
  healthy.damping_to_mass = -5.0;
  EXPECT_THROW(monitor.setBaseline(healthy), std::invalid_argument);
  for (const CornerSample& sample : drive(200)) push(monitor, sample);
  EXPECT_EQ(monitor.baseline().damping_to_mass, kDamping);
}

TEST(StrutMonitor, JudgesByABaseline) {
  StrutMonitor monitor(withPeriod());
  Baseline healthy;
  healthy.damping_to_mass = 2.0 * kDamping;
  healthy.stiffness_to_mass = kStiffness;
  monitor.setBaseline(healthy);
  for (const CornerSample& sample : drive(6000)) push(monitor, sample);
  EXPECT_EQ(monitor.baseline().damping_to_mass, healthy.damping_to_mass);
  ASSERT_TRUE(monitor.report().health.damping_change);
  EXPECT_NEAR(*monitor.report().health.damping_change, -0.5, 0.1);
}

}  // namespace
}  // namespace suspension_health_monitor
