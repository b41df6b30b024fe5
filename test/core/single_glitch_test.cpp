// A reading that is wrong, once: LS has to suffer it for as long as it remembers it, not longer.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.02, kNoise = 0.024, kGlitchTime = 20.0;  // [s], [m/s^2], [s]

std::vector<CornerSample> driveWithGlitch(double seconds, double size, int seed) {
  std::vector<CornerSample> samples = healthyPaperDrive(seconds, kNoise, seed);
  samples[static_cast<std::size_t>(std::lround(kGlitchTime / kPeriod))].unsprung_acceleration += size;
  return samples;
}

MonitorSettings options() {
  MonitorSettings options;
  options.sample_period = kPeriod;
  return options;
}

// @return what is known 90 s after it.
MonitorReport longAfter(double size, int seed) {
  SuspensionMonitor monitor(options());
  for (const CornerSample& sample : driveWithGlitch(kGlitchTime + 90.0, size, seed)) monitor.addSample(sample);
  return monitor.report();
}

// What LS makes of a large one stays in its batches, for two minutes.
TEST(SingleGlitch, LeavesNothingBehind) {
  for (const int seed : {2, 5}) {
    const MonitorReport drive = longAfter(0.0, seed);
    for (const double size : {3.0, 10.0, 100.0}) {
      const MonitorReport report = longAfter(size, seed);
      EXPECT_TRUE(report.health.learned) << size;
      EXPECT_FALSE(report.health.outliers) << size;
      if (size > 10.0) continue;
      EXPECT_LT(report.la.damping_to_mass_stddev, 1.75 * drive.la.damping_to_mass_stddev) << size;
      EXPECT_LT(report.la.stiffness_to_mass_stddev, 1.75 * drive.la.stiffness_to_mass_stddev) << size;
      if (size > 3.0) continue;
      EXPECT_LT(report.ls.damping_to_mass_stddev, 1.75 * drive.ls.damping_to_mass_stddev) << size;
      EXPECT_LT(report.ls.stiffness_to_mass_stddev, 1.75 * drive.ls.stiffness_to_mass_stddev) << size;
    }
  }
}

// From a memory after it on, when LS is as far off as b1 is large.
TEST(SingleGlitch, MakesLsNotValidAsLongAsItIsWrong) {
  constexpr double kMemory = 2.0;  // [s]
  for (int seed = 1; seed <= 5; ++seed) {
    SuspensionMonitor monitor(options());
    double largest = 0.0;
    for (const CornerSample& sample : driveWithGlitch(kGlitchTime + 8.0 * kMemory, 100.0, seed)) {
      const MonitorReport* report = monitor.addSample(sample);
      if (!report || toSeconds(sample.stamp) < kGlitchTime + kMemory) continue;
      const double error = std::abs(report->ls.damping_to_mass - kPaperB1);
      largest = std::fmax(largest, error);
      if (!report->ls.valid()) continue;
      EXPECT_LT(error, std::max(0.05 * kPaperB1, 4.0 * report->ls.damping_to_mass_stddev)) << toSeconds(sample.stamp);
    }
    EXPECT_GT(largest, 0.5 * kPaperB1);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
