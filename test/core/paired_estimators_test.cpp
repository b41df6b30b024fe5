#include "suspension_health_monitor/internal/identification/paired_estimators.h"

#include <gtest/gtest.h>

#include "random_rows.h"

namespace suspension_health_monitor {
namespace {

// b1 is held from the first row on, and what is estimated of the sensors with it: both stay at 0, and b0 is that of a
// regression on its column alone, sum w phi_0 psi / sum w phi_0^2, w = lambda^(k-i).
TEST(PairedEstimators, FitWhatIsNotHeldAloneAndHoldTheSensorsWithEitherParameter) {
  constexpr double kForgetting = 0.98;
  RecursiveOptions recursive;
  recursive.forgetting_factor = kForgetting;
  PairedEstimators estimators(SensorColumns::kOffset, recursive, {});
  estimators.hold(true, false);
  double both = 0.0, square = 0.0;
  for (const RegressionRow& row : randomRows(vectorOf({3.0, 13.8, 2.0}), 1000, 0.1, 1)) {
    estimators.update(row);
    const double stiffness = row.regressor[kStiffnessToMass];
    both = kForgetting * both + stiffness * row.output;
    square = kForgetting * square + stiffness * stiffness;
  }
  EXPECT_NEAR(estimators.leastSquares().parameters()[kStiffnessToMass], both / square, 1e-6);
  for (const Eigen::VectorXd& theta :
       {estimators.leastSquares().parameters(), estimators.leastAbsolute().parameters()}) {
    EXPECT_EQ(theta[kDampingToMass], 0.0);
    EXPECT_EQ(theta[estimators.numModelColumns()], 0.0);
    EXPECT_GT(theta[kStiffnessToMass], 1.0);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
