// The sensors' noise, which pulls least squares down, does not shift the estimate of the blocks.
#include <gtest/gtest.h>

#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kStiffness = 63.3;  // b0 of the golden car [1/s^2]
constexpr double kSettled = 20.0;    // [s]

/// b0 of one estimator: its mean over a drive [1/s^2].
struct MeanStiffness {
  double value = 0.0;
  int count = 0;
  void add(const StrutEstimate& found) { value += (found.stiffness_to_mass - value) / ++count; }
};

// b0 of least squares is 7 % too low. The estimate is a mean of ten minutes, in which it scatters by 2 % / sqrt(60).
TEST(NoiseShift, OfTheBlockEstimateIsNone) {
  SimulationOptions options;
  options.scenario = "iso_road";
  options.vehicle = "golden_car";
  options.iso_class = "A";
  options.speed = 10.0;
  options.rate = 50.0;
  options.duration = 600.0;
  options.noise = 0.02;
  MonitorSettings settings;
  settings.sample_period = 1.0 / options.rate;
  SuspensionMonitor monitor(settings);
  MeanStiffness least_squares, blocks;
  for (const CornerSample& sample : simulate(options)) {
    const MonitorReport& report = *monitor.addSample(sample);
    if (toSeconds(sample.stamp) < kSettled) continue;
    least_squares.add(report.ls);
    blocks.add(report.estimate);
  }
  EXPECT_LT(least_squares.value, 0.95 * kStiffness);
  EXPECT_NEAR(blocks.value, kStiffness, 0.01 * kStiffness);
}

}  // namespace
}  // namespace suspension_health_monitor
