#include <gtest/gtest.h>

#include "suspension_health_monitor/internal/health/assessment.h"

namespace suspension_health_monitor {
namespace {

bool present(double tails, int updates) {
  StrutEstimate ls;
  ls.tails = tails;
  HealthAssessment assessment{HealthThresholds()};
  for (int i = 0; i < updates; ++i) assessment.watch(ls);
  return assessment.update(Stamp(), StrutEstimate(), false).outliers;
}

TEST(Outliers, ArePresentWhereTailsAreHeavyForLong) {
  EXPECT_FALSE(present(1.57, 1000));  // normal
  EXPECT_FALSE(present(2.0, 1000));   // Laplace
  EXPECT_FALSE(present(100.0, 10));   // of a single burst
  EXPECT_TRUE(present(100.0, 1000));
}

TEST(Outliers, AreNotThereWhileNothingIsKnown) { EXPECT_FALSE(present(StrutEstimate().tails, 1000)); }

}  // namespace
}  // namespace suspension_health_monitor
