#include "suspension_health_monitor/internal/health/agreement.h"

#include <gtest/gtest.h>

namespace suspension_health_monitor {
namespace {

constexpr double kMemory = 10.0;  // updates

StrutEstimate strut(double damping, double damping_stddev) {
  StrutEstimate estimate;
  estimate.doubt = EstimateDoubt::kNone;
  estimate.damping_to_mass = damping;
  estimate.damping_to_mass_stddev = damping_stddev;
  estimate.stiffness_to_mass = 60.0;
  estimate.stiffness_to_mass_stddev = 1.0;
  estimate.scatter_is_known = true;
  return estimate;
}

Agreement after(const StrutEstimate& ls, const StrutEstimate& la, int updates) {
  Agreement agreement;
  for (int i = 0; i < updates; ++i) agreement.update(ls, la, kMemory);
  return agreement;
}

TEST(Agreement, FailsForEstimatesThatAreFarApartOrOfDifferentTailsForLong) {
  const StrutEstimate la = strut(6.0, 0.1);
  EXPECT_TRUE(after(strut(6.29, 0.1), la, 1000).holds());
  EXPECT_FALSE(after(strut(6.31, 0.1), la, 1).holds());
  EXPECT_FALSE(after(strut(5.69, 0.1), la, 1).holds());
  EXPECT_TRUE(after(strut(6.0, 0.24), la, 1000).holds());
  EXPECT_FALSE(after(strut(6.0, 0.26), la, 1).holds());
  // A share of 0.4 of ten memories: 1 - exp(-n / 100) = 0.4 after n = 51.
  EXPECT_FALSE(after(strut(6.31, 0.1), la, 45).fails());
  EXPECT_TRUE(after(strut(6.31, 0.1), la, 60).fails());
}

// An engine that shakes the body for long leaves estimates that are valid for seconds only: their scatter is never
// seen.
TEST(Agreement, OfScatterThatNobodyHasSeenSaysNothing) {
  StrutEstimate ls = strut(6.0, 0.5), la = strut(6.0, 0.1);
  ls.scatter_is_known = false;
  EXPECT_TRUE(after(ls, la, 1).holds());
  la.scatter_is_known = false;
  EXPECT_TRUE(after(ls, la, 1).holds());
  ls.damping_to_mass = 7.0;
  EXPECT_FALSE(after(ls, la, 1).holds());
}

TEST(Agreement, NeedsAValidEstimateOfLeastSquares) {
  StrutEstimate ls = strut(6.0, 0.1);
  ls.doubt = EstimateDoubt::kNotExplained;
  EXPECT_FALSE(after(ls, strut(6.0, 0.1), 1).holds());
}

}  // namespace
}  // namespace suspension_health_monitor
