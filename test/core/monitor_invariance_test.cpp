// Nothing may depend on the unit or the offset of the two sensors: b1 and b0 are in 1/s and 1/s^2 whatever u and y are
// in.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

struct Sensors {
  double gain = 1.0, offset = 0.0;
};

CornerSample seenBy(const Sensors& sensors, const CornerSample& sample) {
  return {sample.stamp, sensors.gain * sample.sprung_acceleration + sensors.offset,
          sensors.gain * sample.unsprung_acceleration + sensors.offset};
}

void expectNear(const StrutEstimate& actual, const StrutEstimate& expected, double relative_tolerance) {
  const auto near = [&](double a, double b) { ASSERT_NEAR(a, b, relative_tolerance * std::abs(b)); };
  near(actual.damping_to_mass, expected.damping_to_mass);
  near(actual.stiffness_to_mass, expected.stiffness_to_mass);
  near(actual.damping_to_mass_stddev, expected.damping_to_mass_stddev);
  near(actual.stiffness_to_mass_stddev, expected.stiffness_to_mass_stddev);
  ASSERT_NEAR(actual.explained, expected.explained, relative_tolerance);
  ASSERT_EQ(actual.doubt, expected.doubt);
}

void expectSameEstimates(const std::string& scenario, const Sensors& sensors) {
  SCOPED_TRACE(scenario + ", gain " + std::to_string(sensors.gain) + ", offset " + std::to_string(sensors.offset));
  SimulationOptions drive;
  drive.scenario = scenario;
  SuspensionMonitor reference(liveOptions()), monitor(liveOptions());
  for (const CornerSample& sample : simulate(drive)) {
    const MonitorReport& expected = *reference.addSample(sample);
    const MonitorReport& actual = *monitor.addSample(seenBy(sensors, sample));
    if (!std::isnan(expected.estimate.age)) expectNear(actual.estimate, expected.estimate, 1e-6);
    if (!(expected.la.effective_rows > 0.0)) continue;
    expectNear(actual.ls, expected.ls, 1e-9);
    expectNear(actual.la, expected.la, 1e-9);
    if (testing::Test::HasFatalFailure()) return;
  }
  // A constant is subject to the step error of the free run, 1e-6 of it, which moves a little with b1 and b0.
  EXPECT_NEAR(monitor.report().comparison.rmse, std::abs(sensors.gain) * reference.report().comparison.rmse,
              1e-8 * std::abs(sensors.gain));
}

TEST(MonitorInvariance, EstimatesAndFitAreTheSameInAnyUnit) {
  for (const char* scenario : {"paper_clean", "paper_outliers", "paper_saturation"})
    for (const double gain : {100.0, 1e6, 1e-6}) expectSameEstimates(scenario, {gain, 0.0});
}

TEST(MonitorInvariance, EstimatesAndFitAreTheSameWithBothSensorsUpsideDown) {
  expectSameEstimates("paper_clean", {-1.0, 0.0});
}

TEST(MonitorInvariance, GravityInBothReadingsChangesNothing) {
  for (const char* scenario : {"paper_clean", "paper_saturation"}) expectSameEstimates(scenario, {1.0, 9.81});
}

// The strut s times faster, sampled s times faster, with the memory in samples: b1 s times, b0 s^2 times as large.
TEST(MonitorInvariance, TimeScalesTheParameters) {
  constexpr double kFaster = 64.0;
  MonitorSettings fast_options = liveOptions();
  fast_options.sample_period = 0.02 / kFaster;
  fast_options.integration_horizon = 0.6 / kFaster;
  fast_options.block_length = 2.0 / kFaster;
  fast_options.oldest_data = 60.0 / kFaster;
  fast_options.memory = 2.0 / kFaster;
  SuspensionMonitor reference(liveOptions()), fast(fast_options);
  for (const CornerSample& sample : healthyPaperDrive(30.0, 0.024)) {
    reference.addSample(sample);
    fast.addSample(
        {fromSeconds(toSeconds(sample.stamp) / kFaster), sample.sprung_acceleration, sample.unsprung_acceleration});
  }
  const StrutEstimate& slow_la = reference.report().la;
  const StrutEstimate& fast_la = fast.report().la;
  EXPECT_NEAR(fast_la.damping_to_mass / (kFaster * slow_la.damping_to_mass), 1.0, 1e-9);
  EXPECT_NEAR(fast_la.stiffness_to_mass / (kFaster * kFaster * slow_la.stiffness_to_mass), 1.0, 1e-9);
  EXPECT_NEAR(fast_la.dampingRatio(), slow_la.dampingRatio(), 1e-9);
  EXPECT_NEAR(fast_la.naturalFrequency(), kFaster * slow_la.naturalFrequency(), 1e-7);
}

}  // namespace
}  // namespace suspension_health_monitor
