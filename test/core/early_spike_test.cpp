#include <gtest/gtest.h>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "uniform_grid.h"

namespace suspension_health_monitor {
namespace {

/// A reading as a glitch of the sensor makes it, soon after the start, when there is little to compare it with.
TEST(EarlySpike, IsKeptOut) {
  for (const int when : {0, 3, 15})
    for (const double spike : {1e4, 1e12, 1e30, 9e59}) {
      UniformGrid grid(0.02);
      SuspensionMonitor monitor(liveOptions());
      const std::vector<CornerSample> samples = healthyPaperDrive(20.0, 0.024);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        grid.push(Side::kSprung, samples[i].stamp,
                  i == static_cast<std::size_t>(when) ? spike : samples[i].sprung_acceleration);
        const auto sample = grid.push(Side::kUnsprung, samples[i].stamp, samples[i].unsprung_acceleration);
        if (sample) monitor.addSample(*sample);
      }
      EXPECT_EQ(grid.streams().rejected().count(RejectReason::kAbsurd), 10u);
      EXPECT_TRUE(monitor.report().ls.valid() && monitor.report().la.valid());
      EXPECT_NEAR(monitor.report().la.damping_to_mass, kPaperB1, 0.3);
    }
}

}  // namespace
}  // namespace suspension_health_monitor
