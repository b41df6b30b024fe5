#include <gtest/gtest.h>

#include <algorithm>

#include "suspension_health_monitor/internal/monitor/strut_identifier.h"

namespace suspension_health_monitor {
namespace {

// The same rows beside it say when each output is 0: at rest, but for two readings, one of them tiny and negative.
TEST(StrutIdentifier, HasNoMotionOnceAHorizonOfRowsIsSilentAndMovesAtTheFirstThatIsNot) {
  constexpr int kHorizon = 5, kSamples = 200;
  MonitorSettings settings;
  settings.sample_period = 0.02;
  settings.integration_horizon = 0.02 * kHorizon;
  StrutIdentifier identifier(settings);
  SuspensionRegression regression(settings.filter(0.02), 0, settings.estimators.drifting_offset);
  int silent = 0, begins = 0, ends = 0;
  for (int k = 0; k < kSamples; ++k) {
    const CornerSample sample{fromSeconds(0.02 * k), k == 60 ? -1e-9 : k == 120 ? 0.3 : 0.0, 0.0};
    const bool moved = identifier.moves();
    identifier.add(sample, nullptr);
    if (const RegressionRow* row = regression.push(sample, nullptr)) silent = row->output == 0.0 ? silent + 1 : 0;
    ASSERT_EQ(identifier.moves(), silent < kHorizon) << k;
    begins += int{!moved && identifier.moves()};
    ends += int{moved && !identifier.moves()};
  }
  EXPECT_GE(begins, 2);
  EXPECT_EQ(ends, begins + 1);
}

}  // namespace
}  // namespace suspension_health_monitor
