#include "interval_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace suspension_health_monitor {
namespace {

CleanDrive isoRoad(const std::string& vehicle) {
  SimulationOptions simulation;
  simulation.scenario = "iso_road";
  simulation.vehicle = vehicle;
  simulation.rate = vehicle == "rover" ? 200.0 : 100.0;
  simulation.duration = 120.0;
  return cleanDrive(simulation);
}

// Two vehicles and two levels of noise, 24 measurements each: 95 % of 2000 has a standard deviation of 0.5 %.
TEST(IntervalCoverage, OfTheEstimateAndItsStandardDeviationIs95Percent) {
  Coverages all;
  for (const char* vehicle : {"rover", "paper"}) {
    const CleanDrive drive = isoRoad(vehicle);
    for (const double noise : {0.03, 0.1}) all += coverageOf(drive, noise, {}, 24);
  }
  for (const Coverage& coverage : all) {
    EXPECT_GT(coverage.intervals, 1500);
    EXPECT_GT(coverage.share(), 0.93);
    EXPECT_LT(coverage.share(), 0.99);
  }
}

// The same drive measured again and again: how LS and LA scatter about their mean at one instant. Noise pulls that mean
// down, of which they know nothing. One factor stands for both parameters, so that either may be off by a half.
TEST(IntervalCoverage, StandardDeviationsOfLsAndLaAreThoseOfTheirOwnScatter) {
  constexpr int kSeeds = 40;
  constexpr double kFirst = 40.0, kStep = 10.0;  // [s]
  for (const char* vehicle : {"rover", "paper"}) {
    const CleanDrive drive = isoRoad(vehicle);
    MonitorSettings options;
    options.sample_period = drive.period;
    constexpr std::size_t kTimes = 8;
    struct Sums {
      double value = 0.0, square = 0.0, variance = 0.0;
    };
    std::array<std::array<Sums, 4>, kTimes> sums{};
    for (int seed = 1; seed <= kSeeds; ++seed) {
      SuspensionMonitor monitor(options);
      std::size_t next = 0;
      measure(drive, 0.03, static_cast<unsigned>(seed), [&](const CornerSample& sample) {
        monitor.addSample(sample);
        if (next == kTimes || toSeconds(sample.stamp) < kFirst + kStep * static_cast<double>(next)) return;
        const StrutEstimate &ls = monitor.report().ls, &la = monitor.report().la;
        const auto add = [&](std::size_t i, double value, double stddev) {
          sums[next][i].value += value / kSeeds;
          sums[next][i].square += value * value / kSeeds;
          sums[next][i].variance += stddev * stddev / kSeeds;
        };
        add(0, ls.damping_to_mass, ls.damping_to_mass_stddev);
        add(1, ls.stiffness_to_mass, ls.stiffness_to_mass_stddev);
        add(2, la.damping_to_mass, la.damping_to_mass_stddev);
        add(3, la.stiffness_to_mass, la.stiffness_to_mass_stddev);
        ++next;
      });
    }
    for (std::size_t i = 0; i < 4; ++i) {
      double scatter = 0.0, said = 0.0;
      for (const auto& time : sums) {
        scatter += (time[i].square - time[i].value * time[i].value) * kSeeds / (kSeeds - 1.0);
        said += time[i].variance;
      }
      EXPECT_GT(std::sqrt(said / scatter), 0.67) << vehicle << ' ' << i;
      EXPECT_LT(std::sqrt(said / scatter), 1.5) << vehicle << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace suspension_health_monitor
