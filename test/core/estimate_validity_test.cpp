#include "suspension_health_monitor/estimate_validity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace suspension_health_monitor {
namespace {

TEST(EstimateValidity, NoMoreRowsAreWantedThanNineTenthsOfTheMemory) {
  EXPECT_DOUBLE_EQ(fewestRows(50, 0.99), 50.0);
  EXPECT_NEAR(fewestRows(50, 0.98), 45.0, 1e-9);
  EXPECT_DOUBLE_EQ(fewestRows(50, 1.0), 50.0);
}

TEST(EstimateValidity, ExplainedIsWhatTheRowsLeaveOfTheOutput) {
  RecursiveOptions options;
  options.forgetting_factor = 1.0;
  RecursiveLeastSquares estimator(1, options);
  EXPECT_EQ(explained(estimator), 0.0);
  double residuals = 0.0, outputs = 0.0;
  for (int k = 0; k < 100; ++k) {
    const RegressionRow row{Eigen::VectorXd::Constant(1, std::sin(0.3 * k + 1.0)), 3.0 * std::sin(0.3 * k + 1.0) + 0.1};
    residuals += std::abs(row.output - row.regressor[0] * estimator.parameters()[0]);
    outputs += std::abs(row.output);
    estimator.update(row);
  }
  EXPECT_NEAR(explained(estimator), 1.0 - residuals / outputs, 1e-12);
}

TEST(MotionJudge, EndsWithSoManySilentRowsAndBeginsWithTheFirstThatIsNot) {
  MotionJudge motion(3);
  for (const double output : {0.0, 0.0, -1e-9, 0.0, 0.0}) EXPECT_TRUE(motion.moves(output));
  for (int k = 0; k < 5; ++k) EXPECT_FALSE(motion.moves(0.0));
  EXPECT_TRUE(motion.moves(1e-9));
}

}  // namespace
}  // namespace suspension_health_monitor
