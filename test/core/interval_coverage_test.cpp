#include "interval_coverage.h"

#include <gtest/gtest.h>

namespace suspension_health_monitor {
namespace {

// Two vehicles, three horizons, twelve measurements each. Intervals three memories of LS apart, one memory of LA's, are
// taken as half as many independent ones: 95 % of n/2 has a standard deviation of 0.6 % here; 92 % and 98 % are the
// claim.
TEST(IntervalCoverage, OfEstimatesAndTheirStandardDeviationsIs95Percent) {
  Coverages all;
  for (const char* vehicle : {"rover", "paper"}) {
    SimulationOptions simulation;
    simulation.scenario = "iso_road";
    simulation.vehicle = vehicle;
    simulation.rate = vehicle == std::string("rover") ? 200.0 : 100.0;
    simulation.duration = 120.0;
    const CleanDrive drive = cleanDrive(simulation);
    const int proposed = proposedHorizon(drive, 0.03);
    for (const double horizon : {0.6, 1.0, 1.6}) {
      MonitorSettings options;
      options.integration_horizon = horizon * proposed / simulation.rate;
      all += coverageOf(drive, 0.03, options, 24);
    }
  }
  for (const auto& estimator : all)
    for (const Coverage& coverage : estimator) {
      EXPECT_GT(coverage.intervals, 2000);
      EXPECT_GT(coverage.share(), 0.92);
      EXPECT_LT(coverage.share(), 0.98);
    }
}

}  // namespace
}  // namespace suspension_health_monitor
