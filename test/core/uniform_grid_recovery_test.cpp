// Streams that jump, run ahead or fall silent: the grid goes on.
#include <gtest/gtest.h>

#include <chrono>

#include "milliseconds.h"
#include "uniform_grid.h"

namespace suspension_health_monitor {
namespace {

class Streams : public testing::Test {
 protected:
  // Both sensors in step from `first` on; returns how many samples came.
  int run(int first, int count) {
    int samples = 0;
    for (int k = 0; k < count; ++k) {
      grid_.push(Side::kSprung, at(first + 20 * k), k);
      if (grid_.push(Side::kUnsprung, at(first + 20 * k), -k)) ++samples;
    }
    return samples;
  }

  UniformGrid grid_{0.02};
};

TEST_F(Streams, GoOnAfterABagThatLoops) {
  for (int pass = 0; pass < 5; ++pass) EXPECT_GE(run(500000, 300), 299);
  EXPECT_EQ(grid_.streams().rejected().count(RejectReason::kTimeWentBack), 4u);
}

TEST_F(Streams, GoOnAfterAStampFarInTheFuture) {
  run(1000, 10);
  grid_.push(Side::kUnsprung, std::chrono::hours(24 * 365), 7.0);
  for (int k = 0; k < 10; ++k) grid_.push(Side::kUnsprung, std::chrono::hours(24 * 365), 7.0);  // stuck there
  EXPECT_EQ(grid_.streams().rejected().count(RejectReason::kRepeatedStamp), 10u);
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(grid_.push(Side::kSprung, at(1200 + 20 * k), k));
  EXPECT_GE(run(3200, 50), 49);
}

TEST_F(Streams, GoOnAfterAStampSomewhatInTheFuture) {
  run(1000, 10);
  grid_.push(Side::kUnsprung, at(1200 + 500), 7.0);  // within 50 samples it counts as a message that overtook others
  EXPECT_GE(run(1200, 100), 100 - 26);
}

TEST_F(Streams, SilenceOfOneFillsNoMemoryAndIsMadeGood) {
  run(0, 10);
  const int many = 3 * static_cast<int>(kMostWaiting);
  for (int k = 0; k < many; ++k) EXPECT_FALSE(grid_.push(Side::kSprung, at(200 + 20 * k), 0.01 * k));
  // All but the capacity is gone already, the rest goes when the other one comes back.
  EXPECT_EQ(grid_.streams().rejected().count(RejectReason::kMissingPartner), 2 * kMostWaiting);
  EXPECT_EQ(run(200 + 20 * many, 100), 100);
  EXPECT_EQ(grid_.streams().rejected().count(RejectReason::kMissingPartner), 3 * kMostWaiting);
}

TEST_F(Streams, OneMayRunAheadByTheCapacity) {
  const int most = static_cast<int>(kMostWaiting);
  for (int k = 0; k < most; ++k) grid_.push(Side::kSprung, at(20 * k), 0.01 * k);
  for (int k = 0; k < most; ++k) {
    const auto sample = grid_.push(Side::kUnsprung, at(20 * k), -0.01 * k);
    ASSERT_TRUE(sample);
    ASSERT_EQ(sample->sprung_acceleration, 0.01 * k);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
