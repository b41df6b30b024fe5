#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "interval_coverage.h"
#include "quarter_car.h"
#include "simulated_drive.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"

namespace suspension_health_monitor {
namespace {

/// A drive without noise over a tyre that gives.
struct CleanTyreDrive {
  SimulationOptions simulation;
  std::vector<DriveSample> samples;
  QuarterCar car;
};

CleanTyreDrive cleanTyreDrive(const char* vehicle, double rate, double duration) {
  SimulationOptions simulation = scenario("iso_road", duration);
  simulation.vehicle = vehicle;
  simulation.rate = rate;
  simulation.noise = 0.0;
  return {simulation, drive(simulation), carOf(simulation)};
}

using TyreCoverages = std::array<std::array<Coverage, 3>, 2>;  // by estimator (LS, LA) and parameter

void add(const WheelEstimate& estimate, const QuarterCar& car, std::array<Coverage, 3>& coverages) {
  const double m = car.unsprung_mass;
  coverages[0].add(estimate.damping_to_wheel_mass - car.damping / m, estimate.damping_to_wheel_mass_stddev);
  coverages[1].add(estimate.stiffness_to_wheel_mass - car.stiffness / m, estimate.stiffness_to_wheel_mass_stddev);
  coverages[2].add(estimate.tyre_to_wheel_mass - *car.tyre_stiffness / m, estimate.tyre_to_wheel_mass_stddev);
}

/// The three sensors read with normal white noise of the same size. Looked at every three memories, from the tenth on.
void measure(const CleanTyreDrive& clean, double noise, unsigned seed, double lambda, TyreCoverages& coverages) {
  MonitorSettings options;
  options.sample_period = 1.0 / clean.simulation.rate;
  options.forgetting_factor = lambda;
  TyreTracker tracker(options);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, noise);
  const auto every = static_cast<std::uint64_t>(3.0 / (1.0 - lambda));
  std::uint64_t rows = 0;
  for (const DriveSample& sample : clean.samples) {
    const CornerSample measured{sample.stamp, sample.sprung->acceleration + normal(generator),
                                sample.unsprung->acceleration + normal(generator)};
    const TyreReport& report = tracker.add(measured, sample.road->acceleration + normal(generator));
    if (!report.has_row || ++rows < 3 * every || rows % every != 0) continue;
    add(report.ls, clean.car, coverages[0]);
    add(report.la, clean.car, coverages[1]);
  }
}

// Three vehicles whose wheels hop at 9 to 13 Hz, memories of 1.3 and 3.3 windows of the filter, twelve measurements
// each. Intervals taken as half as many independent ones, 95 % has a standard deviation of 0.5 %; 92 % and 98 % are the
// claim of LS. Those of LA are too short by a quarter: its weights' mean is not the density of its residuals at 0.
TEST(TyreCoverage, OfEstimatesAndTheirStandardDeviationsIs95Percent) {
  TyreCoverages all;
  for (const char* vehicle : {"golden_car", "rover", "ugv"}) {
    const CleanTyreDrive clean = cleanTyreDrive(vehicle, 1000.0, 60.0);
    for (const double lambda : {0.995, 0.998})
      for (unsigned seed = 1; seed <= 12; ++seed) measure(clean, 0.03, seed, lambda, all);
  }
  const std::array<double, 2> least{0.92, 0.8};  // of LS, LA
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const Coverage& coverage : all[i]) {
      EXPECT_GT(coverage.intervals, 4000);
      EXPECT_GT(coverage.share(), least[i]);
      EXPECT_LT(coverage.share(), 0.98);
    }
}

}  // namespace
}  // namespace suspension_health_monitor
