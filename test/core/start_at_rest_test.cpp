// A vehicle that stands for a while before it drives off, as every one does.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

// @return what is known after 90 s of the paper's road, driven after so long a rest.
MonitorReport afterRestOf(double seconds) {
  constexpr double kPeriod = 0.02, kNoise = 0.024;
  MonitorSettings options;
  options.sample_period = kPeriod;
  SuspensionMonitor monitor(options);
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, kNoise);
  std::vector<CornerSample> samples;
  for (int k = 0; k * kPeriod < seconds; ++k) {
    const double sprung = noise(random);
    samples.push_back({{}, sprung, noise(random)});
  }
  for (const CornerSample& sample : healthyPaperDrive(90.0, kNoise, 2)) samples.push_back(sample);
  Stamp stamp{};
  for (CornerSample& sample : samples) {
    sample.stamp = stamp += fromSeconds(kPeriod);
    monitor.addSample(sample);
  }
  return monitor.report();
}

TEST(StartAtRest, LeavesSpreadsAndHealthAsTheyAreWithoutIt) {
  const MonitorReport drive = afterRestOf(0.0);
  for (const double seconds : {3.0, 4.0, 10.0, 100.0}) {
    const MonitorReport report = afterRestOf(seconds);
    EXPECT_LT(report.ls.damping_to_mass_stddev, 1.5 * drive.ls.damping_to_mass_stddev) << seconds;
    EXPECT_LT(report.ls.stiffness_to_mass_stddev, 1.5 * drive.ls.stiffness_to_mass_stddev) << seconds;
    EXPECT_LT(report.la.damping_to_mass_stddev, 1.5 * drive.la.damping_to_mass_stddev) << seconds;
    EXPECT_LT(report.la.stiffness_to_mass_stddev, 1.5 * drive.la.stiffness_to_mass_stddev) << seconds;
    EXPECT_TRUE(report.estimate.valid()) << seconds;
    EXPECT_LT(report.estimate.damping_to_mass_stddev, 1.5 * drive.estimate.damping_to_mass_stddev) << seconds;
    EXPECT_LT(report.estimate.stiffness_to_mass_stddev, 1.5 * drive.estimate.stiffness_to_mass_stddev) << seconds;
    EXPECT_FALSE(report.health.outliers) << seconds;
    EXPECT_TRUE(report.health.learned) << seconds;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
