#include "suspension_health_monitor/signal/uniform_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "suspension_health_monitor/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr Stamp kPeriod = std::chrono::milliseconds(20);

Stamp at(int milliseconds) { return std::chrono::milliseconds(milliseconds); }

struct Message {
  Side side;
  Stamp stamp;
  double acceleration;
};

std::vector<CornerSample> pairs(UniformGrid& grid, const std::vector<Message>& messages) {
  std::vector<CornerSample> samples;
  for (const Message& message : messages)
    if (const auto sample = grid.push(message.side, message.stamp, message.acceleration)) samples.push_back(*sample);
  return samples;
}

void expectEqual(const std::vector<CornerSample>& actual, const std::vector<CornerSample>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    ASSERT_EQ(actual[i].stamp, expected[i].stamp) << i;
    ASSERT_EQ(actual[i].sprung_acceleration, expected[i].sprung_acceleration) << i;
    ASSERT_EQ(actual[i].unsprung_acceleration, expected[i].unsprung_acceleration) << i;
  }
}

TEST(Continuity, TellsSpacingsApartAtHalfAndAtThreeHalvesOfThePeriod) {
  const Stamp ns(1);
  EXPECT_EQ(continuity(-ns, kPeriod), Continuity::kClockJumped);
  EXPECT_EQ(continuity(Stamp::zero(), kPeriod), Continuity::kTooSoon);
  EXPECT_EQ(continuity(at(10), kPeriod), Continuity::kTooSoon);
  EXPECT_EQ(continuity(at(10) + ns, kPeriod), Continuity::kContinues);
  EXPECT_EQ(continuity(at(30) - ns, kPeriod), Continuity::kContinues);
  EXPECT_EQ(continuity(at(30), kPeriod), Continuity::kGap);
}

TEST(UniformGrid, GivesTheSampleWithTheReadingThatCompletesItStampedByTheBody) {
  UniformGrid grid(0.02);
  EXPECT_FALSE(grid.push(Side::kUnsprung, at(3), 2.0));
  const auto sample = grid.push(Side::kSprung, at(0), 1.0);
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->stamp, at(0));
  EXPECT_EQ(sample->sprung_acceleration, 1.0);
  EXPECT_EQ(sample->unsprung_acceleration, 2.0);
  EXPECT_FALSE(grid.push(Side::kSprung, at(20), 3.0));
  EXPECT_EQ(grid.push(Side::kUnsprung, at(23), 4.0)->stamp, at(20));
  EXPECT_EQ(grid.rejected().total(), 0u);
}

TEST(UniformGrid, PairsStampsUpToHalfASampleApart) {
  for (const int sign : {-1, 1}) {
    UniformGrid on_the_boundary(0.02), beyond(0.02);
    on_the_boundary.push(Side::kSprung, at(100), 1.0);
    EXPECT_TRUE(on_the_boundary.push(Side::kUnsprung, at(100 + sign * 10), 2.0));
    beyond.push(Side::kSprung, at(100), 1.0);
    EXPECT_FALSE(beyond.push(Side::kUnsprung, at(100 + sign * 10) + sign * Stamp(1), 2.0));
    EXPECT_EQ(beyond.rejected().count(RejectReason::kMissingPartner), 1u);  // the older of the two
  }
}

TEST(UniformGrid, LeavesOutWhatHasNoPartnerAndGoesOn) {
  UniformGrid grid(0.02);
  const std::vector<CornerSample> samples = pairs(grid, {{Side::kSprung, at(0), 0.0},
                                                         {Side::kUnsprung, at(0), 10.0},
                                                         {Side::kSprung, at(20), 1.0},
                                                         {Side::kSprung, at(40), 2.0},
                                                         {Side::kUnsprung, at(40), 12.0},
                                                         {Side::kUnsprung, at(60), 13.0},
                                                         {Side::kUnsprung, at(80), 14.0},
                                                         {Side::kSprung, at(80), 4.0}});
  expectEqual(samples, {{at(0), 0.0, 10.0}, {at(40), 2.0, 12.0}, {at(80), 4.0, 14.0}});
  EXPECT_EQ(grid.rejected().count(RejectReason::kMissingPartner), 2u);
  EXPECT_EQ(grid.rejected().total(), 2u);
}

TEST(UniformGrid, TakesTwoRatesByTheSlowerOne) {
  UniformGrid grid(0.02);
  std::vector<Message> messages;
  for (int k = 0; k < 100; ++k) {
    messages.push_back({Side::kSprung, at(5 * k), 1.0 * k});
    if (k % 4 == 0) messages.push_back({Side::kUnsprung, at(5 * k), 100.0 + k});
  }
  for (const CornerSample& sample : pairs(grid, messages)) {
    const double lag = sample.unsprung_acceleration - 100.0 - sample.sprung_acceleration;
    EXPECT_LE(std::abs(lag), 2.0);  // of the 5 ms readings: within 10 ms
  }
}

class Interleaving : public testing::Test {
 protected:
  // Two streams with jitter, lost messages and now and then a reading that must be refused.
  std::vector<Message> stream(Side side) {
    std::vector<Message> messages;
    for (int k = 0; k < 400; ++k) {
      if (uniform() < 0.1) continue;
      const Stamp stamp = k * kPeriod + Stamp(static_cast<long>(uniform() * 1.2e7));
      const double acceleration = uniform() < 0.05 ? std::nan("") : k + uniform();
      messages.push_back({side, stamp, acceleration});
      if (uniform() < 0.05) messages.push_back({side, stamp, -1.0});                // repeated
      if (uniform() < 0.05) messages.push_back({side, stamp - 3 * kPeriod, -2.0});  // overtaken
    }
    return messages;
  }

  std::vector<Message> interleaved(const std::vector<Message>& a, const std::vector<Message>& b, double bias) {
    std::vector<Message> merged;
    for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
      const bool take_a = j == b.size() || (i < a.size() && uniform() < bias);
      merged.push_back(take_a ? a[i++] : b[j++]);
    }
    return merged;
  }

  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(engine_); }

  std::mt19937_64 engine_{11};
};

TEST_F(Interleaving, OfTheStreamsDoesNotMatter) {
  for (int drive = 0; drive < 10; ++drive) {
    const std::vector<Message> body = stream(Side::kSprung), wheel = stream(Side::kUnsprung);
    UniformGrid body_first(0.02);
    const std::vector<CornerSample> expected = pairs(body_first, interleaved(body, wheel, 1.0));
    EXPECT_GT(expected.size(), 200u);
    for (const double bias : {0.0, 0.03, 0.3, 0.5, 0.5, 0.5, 0.97}) {
      UniformGrid grid(0.02);
      expectEqual(pairs(grid, interleaved(body, wheel, bias)), expected);
      for (const auto reason : {RejectReason::kNotFinite, RejectReason::kRepeatedStamp, RejectReason::kTimeWentBack})
        EXPECT_EQ(grid.rejected().count(reason), body_first.rejected().count(reason));
    }
  }
}

TEST_F(Interleaving, GivesSamplesInOrderOfTime) {
  UniformGrid grid(0.02);
  const std::vector<CornerSample> samples =
      pairs(grid, interleaved(stream(Side::kSprung), stream(Side::kUnsprung), 0.5));
  for (std::size_t i = 1; i < samples.size(); ++i) ASSERT_LT(samples[i - 1].stamp, samples[i].stamp);
}

TEST(UniformGrid, CountsEveryReasonToRefuseAReading) {
  UniformGrid grid(0.02);
  grid.push(Side::kSprung, at(1000), 1.0);
  grid.push(Side::kSprung, at(1020), std::nan(""));
  grid.push(Side::kSprung, at(1020), std::numeric_limits<double>::infinity());
  EXPECT_EQ(grid.rejected().count(RejectReason::kNotFinite), 2u);
  grid.push(Side::kSprung, Stamp::zero(), 1.0);
  EXPECT_EQ(grid.rejected().count(RejectReason::kZeroStamp), 1u);
  grid.push(Side::kSprung, at(1000), 2.0);
  EXPECT_EQ(grid.rejected().count(RejectReason::kRepeatedStamp), 1u);
  grid.push(Side::kSprung, at(980), 2.0);
  EXPECT_EQ(grid.rejected().count(RejectReason::kTimeWentBack), 1u);
  grid.push(Side::kUnsprung, at(1040), 2.0);
  EXPECT_EQ(grid.rejected().count(RejectReason::kMissingPartner), 1u);
  EXPECT_EQ(grid.rejected().total(), 6u);
  EXPECT_EQ(grid.rejected().count(RejectReason::kNotMeasured), 0u);
  EXPECT_EQ(grid.rejected().count(RejectReason::kTooSoon), 0u);
  // None of them stands in the way of what comes next.
  EXPECT_TRUE(grid.push(Side::kSprung, at(1040), 1.0));
}

TEST(UniformGrid, RefusesNaNBeforeItCanPair) {
  UniformGrid grid(0.02);
  EXPECT_FALSE(grid.push(Side::kSprung, at(0), std::nan("")));
  EXPECT_FALSE(grid.push(Side::kUnsprung, at(0), 2.0));
  EXPECT_EQ(grid.push(Side::kSprung, at(0), 1.0)->sprung_acceleration, 1.0);
}

TEST(UniformGrid, SeriesMayStartAtStampZeroButNotStayThere) {
  UniformGrid grid(0.02);
  grid.push(Side::kSprung, Stamp::zero(), 1.0);
  EXPECT_TRUE(grid.push(Side::kUnsprung, Stamp::zero(), 1.0));
  for (int k = 0; k < 10; ++k) EXPECT_FALSE(grid.push(Side::kSprung, Stamp::zero(), 1.0));
  EXPECT_EQ(grid.rejected().count(RejectReason::kZeroStamp), 10u);
}

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
  EXPECT_EQ(grid_.rejected().count(RejectReason::kTimeWentBack), 4u);
}

TEST_F(Streams, GoOnAfterAStampFarInTheFuture) {
  run(1000, 10);
  grid_.push(Side::kUnsprung, std::chrono::hours(24 * 365), 7.0);
  for (int k = 0; k < 10; ++k) grid_.push(Side::kUnsprung, std::chrono::hours(24 * 365), 7.0);  // stuck there
  EXPECT_EQ(grid_.rejected().count(RejectReason::kRepeatedStamp), 10u);
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
  const int many = 3 * static_cast<int>(UniformGrid::kMostWaiting);
  for (int k = 0; k < many; ++k) EXPECT_FALSE(grid_.push(Side::kSprung, at(200 + 20 * k), k));
  // All but the capacity is gone already, the rest goes when the other one comes back.
  EXPECT_EQ(grid_.rejected().count(RejectReason::kMissingPartner), 2 * UniformGrid::kMostWaiting);
  EXPECT_EQ(run(200 + 20 * many, 100), 100);
  EXPECT_EQ(grid_.rejected().count(RejectReason::kMissingPartner), 3 * UniformGrid::kMostWaiting);
}

TEST_F(Streams, OneMayRunAheadByTheCapacity) {
  const int most = static_cast<int>(UniformGrid::kMostWaiting);
  for (int k = 0; k < most; ++k) grid_.push(Side::kSprung, at(20 * k), k);
  for (int k = 0; k < most; ++k) {
    const auto sample = grid_.push(Side::kUnsprung, at(20 * k), -k);
    ASSERT_TRUE(sample);
    ASSERT_EQ(sample->sprung_acceleration, k);
  }
}

TEST(UniformGrid, RefusesAPeriodThatIsNone) {
  for (const double period : {0.0, -0.02, 1e-12, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(UniformGrid{period}, std::invalid_argument) << period;
}

TEST(UniformGrid, KeepsAnAbsurdSpikeOutAndTakesANewLevelAfterThree) {
  UniformGrid grid(0.02);
  const auto push = [&](int k, double wheel) {
    grid.push(Side::kSprung, at(20 * k), 9.81 + 0.01 * (k % 2));
    return grid.push(Side::kUnsprung, at(20 * k), wheel).has_value();
  };
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(push(k, 9.0 + 0.01 * (k % 2)));
  EXPECT_TRUE(push(200, -8e6));  // large, but not a million times the usual
  EXPECT_FALSE(push(201, 1e15));
  EXPECT_EQ(grid.rejected().count(RejectReason::kAbsurd), 1u);
  EXPECT_TRUE(push(202, 9.0));
  EXPECT_FALSE(push(203, 1e15));
  EXPECT_FALSE(push(204, 1e15));
  EXPECT_FALSE(push(205, -1e15));
  EXPECT_TRUE(push(206, 1e15));  // then it is how the sensor reads now
  EXPECT_EQ(grid.rejected().count(RejectReason::kAbsurd), 4u);
}

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

  UniformGrid grid_{0.02, {Alignment::kPaired, true}};
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
  EXPECT_EQ(grid_.rejected().count(RejectReason::kMissingPartner), 1u);
}

TEST_F(WithRoad, ASilentRoadHoldsTheStrutUpForALimitedTimeOnly) {
  const int lag = static_cast<int>(UniformGrid::kMostRoadLag);
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
