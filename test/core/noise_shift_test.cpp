// What the sensors' noise shifts the estimates by is taken off them, whole.
#include <gtest/gtest.h>

#include <cmath>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kStiffness = 63.3;  // b0 of the golden car [1/s^2]
constexpr double kMemory = 20.0;     // [s]
constexpr double kSettled = 240.0;   // twice what a level of noise is a mean over [s]

/// b0 of one estimator: the mean over a drive, and its standard deviation in it [1/s^2].
struct MeanStiffness {
  double value = 0.0, stddev = 0.0;
};

MeanStiffness meanStiffness(bool removes_noise_shift, const StrutEstimate MonitorReport::*estimate) {
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
  settings.memory = kMemory;
  settings.estimators.removes_noise_shift = removes_noise_shift;
  SuspensionMonitor monitor(settings);
  MeanStiffness mean;
  int count = 0;
  for (const CornerSample& sample : simulate(options)) {
    const StrutEstimate& found = monitor.addSample(sample)->*estimate;
    if (toSeconds(sample.stamp) < kSettled) continue;
    ++count;
    mean.value += (found.stiffness_to_mass - mean.value) / count;
    mean.stddev += (found.stiffness_to_mass_stddev - mean.stddev) / count;
  }
  mean.stddev /= std::sqrt((options.duration - kSettled) /
                           (2.0 * kMemory));  // estimates of an exponential memory are alike over two of it
  return mean;
}

// Left in, it is 11 % of b0. What least squares fits of the noise is missing from what it leaves: a level of the noise
// by that alone is a tenth too low, and so would be the shift.
TEST(NoiseShift, IsTakenOffWhole) {
  for (const auto estimate : {&MonitorReport::ls, &MonitorReport::la}) {
    const MeanStiffness left_in = meanStiffness(false, estimate), found = meanStiffness(true, estimate);
    EXPECT_LT(left_in.value, 0.92 * kStiffness);
    EXPECT_NEAR(found.value, kStiffness, 2.0 * found.stddev);
    EXPECT_NEAR(found.value, kStiffness, 0.1 * (kStiffness - left_in.value));
  }
}

}  // namespace
}  // namespace suspension_health_monitor
