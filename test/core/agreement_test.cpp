#include "suspension_health_monitor/internal/health/agreement.h"

#include <gtest/gtest.h>

namespace suspension_health_monitor {
namespace {

StrutEstimate strut(double damping, double damping_stddev) {
  StrutEstimate estimate;
  estimate.damping_to_mass = damping;
  estimate.damping_to_mass_stddev = damping_stddev;
  estimate.stiffness_to_mass = 60.0;
  estimate.stiffness_to_mass_stddev = 1.0;
  return estimate;
}

bool fails(const StrutEstimate& ls, const StrutEstimate& la, int updates) {
  Agreement agreement;
  for (int i = 0; i < updates; ++i) agreement.update(ls, la);
  return agreement.fails();
}

TEST(Agreement, FailsForEstimatesThatAreFarApartForLong) {
  const StrutEstimate la = strut(6.0, 0.1);  // of both, 4 standard deviations are 0.566
  EXPECT_FALSE(fails(strut(6.56, 0.1), la, 1000));
  EXPECT_TRUE(fails(strut(6.57, 0.1), la, 1000));
  EXPECT_TRUE(fails(strut(5.43, 0.1), la, 1000));
  EXPECT_FALSE(fails(strut(6.29, 1e-3), strut(6.0, 1e-3), 1000));  // within 5 %
  // A share of 0.4 of fifty updates: 1 - (1 - 1/50)^n > 0.4 from n = 26 on.
  EXPECT_FALSE(fails(strut(6.57, 0.1), la, 25));
  EXPECT_TRUE(fails(strut(6.57, 0.1), la, 26));
}

TEST(Agreement, FailsWhileNothingIsKnown) { EXPECT_TRUE(fails({}, {}, 1000)); }

}  // namespace
}  // namespace suspension_health_monitor
