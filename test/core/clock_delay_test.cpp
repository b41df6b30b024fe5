// Two IMUs whose clocks differ: the difference is estimated beside the strut, of which it then is no part.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 6.0, kB0 = 63.3;  // of the golden car
constexpr int kEvery = 5;                // of 1000 Hz

// Every ms of a minute's drive.
std::vector<CornerSample> fineDrive(const char* iso_class) {
  SimulationOptions options;
  options.scenario = "iso_road";
  options.vehicle = "golden_car";
  options.iso_class = iso_class;
  options.rate = 1000.0;
  options.damping_end_fraction = 1.0;
  options.duration = 60.0;
  return simulate(options);
}

// The wheel's readings are those of `late` ms before.
std::vector<CornerSample> driveWith(int late, const std::vector<CornerSample>& fine) {
  std::vector<CornerSample> drive;
  const int count = static_cast<int>(fine.size());
  for (int k = std::abs(late); k + std::abs(late) < count; k += kEvery) {
    drive.push_back(fine[static_cast<std::size_t>(k)]);
    drive.back().unsprung_acceleration = fine[static_cast<std::size_t>(k - late)].unsprung_acceleration;
  }
  return drive;
}

MonitorReport reportOf(const std::vector<CornerSample>& drive) {
  MonitorOptions options;
  options.sample_period = 1e-3 * kEvery;
  SuspensionMonitor monitor(options);
  for (const CornerSample& sample : drive) monitor.addSample(sample);
  return monitor.report();
}

void expectRight(const StrutEstimate& estimate) {
  EXPECT_NEAR(estimate.damping_to_mass, kB1, std::max(0.02 * kB1, 2.6 * estimate.damping_to_mass_stddev));
  EXPECT_NEAR(estimate.stiffness_to_mass, kB0, std::max(0.02 * kB0, 2.6 * estimate.stiffness_to_mass_stddev));
}

TEST(ClockDelay, IsEstimatedAndChangesNoEstimate) {
  for (const char* road : {"A", "C"}) {
    const std::vector<CornerSample> fine = fineDrive(road);
    for (const int late : {-20, -10, -3, -1, 0, 1, 3, 10, 20}) {
      SCOPED_TRACE(std::string(road) + ", " + std::to_string(late) + " ms");
      const MonitorReport report = reportOf(driveWith(late, fine));
      const StrutEstimate& estimate = report.estimate;
      EXPECT_TRUE(estimate.valid()) << describe(estimate.doubt);
      EXPECT_TRUE(late != 0 || report.la.valid()) << describe(report.la.doubt);
      expectRight(estimate);
      EXPECT_LT(estimate.stiffness_to_mass_stddev, 0.1 * kB0);
      EXPECT_NEAR(estimate.delay, 1e-3 * late, 0.2e-3);
      EXPECT_LT(std::abs(estimate.delay - 1e-3 * late), 4.0 * estimate.delay_stddev);
    }
  }
}

TEST(ClockDelay, ThatIsTooLargeIsADoubtOrRight) {
  const std::vector<CornerSample> fine = fineDrive("C");
  for (const int late : {30, -30, 50, -50}) {
    SCOPED_TRACE(late);
    const StrutEstimate estimate = reportOf(driveWith(late, fine)).estimate;
    if (estimate.valid()) expectRight(estimate);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
