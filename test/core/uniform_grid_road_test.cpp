// A third stream, of the road's sensor, that the strut can do without.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "milliseconds.h"
#include "uniform_grid.h"

namespace suspension_health_monitor {
namespace {

class WithRoad : public testing::Test {
 protected:
  // What the grid gives for a reading: stamps [ms] of the samples, and the road's value at each, NaN without one.
  void push(Side side, int milliseconds, double acceleration) {
    for (auto sample = grid_.push(side, at(milliseconds), acceleration); sample; sample = grid_.next()) {
      stamps_.push_back(static_cast<int>(sample->stamp / at(1)));
      road_.push_back(grid_.roadAcceleration().value_or(std::nan("")));
    }
  }
  void pushStrut(int milliseconds) {
    push(Side::kSprung, milliseconds, 1.0);
    push(Side::kUnsprung, milliseconds, 2.0);
  }

  UniformGrid grid_{0.02, {}, true};
  std::vector<int> stamps_;
  std::vector<double> road_;
};

TEST_F(WithRoad, ASampleWaitsForTheRoadsReadingAndGivesItsValue) {
  pushStrut(0);
  EXPECT_TRUE(stamps_.empty());
  push(Side::kRoad, -30, 7.0);  // belongs to none
  push(Side::kRoad, 10, 8.0);
  EXPECT_EQ(stamps_, std::vector{0});
  EXPECT_EQ(road_, std::vector{8.0});
  push(Side::kRoad, 45, 9.0);
  pushStrut(20);
  pushStrut(40);
  EXPECT_EQ(stamps_, (std::vector{0, 20, 40}));
  EXPECT_TRUE(std::isnan(road_[1]));
  EXPECT_EQ(road_[2], 9.0);
  EXPECT_EQ(grid_.streams().rejected().count(RejectReason::kMissingPartner), 1u);
}

TEST_F(WithRoad, ASilentRoadHoldsTheStrutUpForALimitedTimeOnly) {
  const int lag = static_cast<int>(kMostOptionalLag / std::chrono::milliseconds(20)) + 1;
  for (int k = 0; k < lag; ++k) pushStrut(20 * k);
  EXPECT_TRUE(stamps_.empty());
  pushStrut(20 * lag);
  EXPECT_EQ(stamps_.size(), lag + 1u);  // all that had waited
  pushStrut(20 * lag + 20);
  EXPECT_EQ(stamps_.size(), lag + 2u);  // and no more waiting
  push(Side::kRoad, 20 * lag + 40, 5.0);
  pushStrut(20 * lag + 40);
  EXPECT_EQ(road_.back(), 5.0);
}

}  // namespace
}  // namespace suspension_health_monitor
