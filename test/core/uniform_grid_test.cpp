#include "uniform_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "interleaved.h"
#include "milliseconds.h"

namespace suspension_health_monitor {
namespace {

constexpr Stamp kPeriod = std::chrono::milliseconds(20);

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
  EXPECT_EQ(grid.streams().rejected().total(), 0u);
}

TEST(UniformGrid, PairsStampsUpToHalfASampleApart) {
  for (const int sign : {-1, 1}) {
    UniformGrid on_the_boundary(0.02), beyond(0.02);
    on_the_boundary.push(Side::kSprung, at(100), 1.0);
    EXPECT_TRUE(on_the_boundary.push(Side::kUnsprung, at(100 + sign * 10), 2.0));
    beyond.push(Side::kSprung, at(100), 1.0);
    EXPECT_FALSE(beyond.push(Side::kUnsprung, at(100 + sign * 10) + sign * Stamp(1), 2.0));
    EXPECT_EQ(beyond.streams().rejected().count(RejectReason::kMissingPartner), 1u);  // the older of the two
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
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kMissingPartner), 2u);
  EXPECT_EQ(grid.streams().rejected().total(), 2u);
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

  std::vector<Message> merged(const std::vector<Message>& a, const std::vector<Message>& b, double bias) {
    return interleaved(a, b, bias, [this] { return uniform(); });
  }

  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(engine_); }

  std::mt19937_64 engine_{11};
};

TEST_F(Interleaving, OfTheStreamsDoesNotMatter) {
  for (int drive = 0; drive < 10; ++drive) {
    const std::vector<Message> body = stream(Side::kSprung), wheel = stream(Side::kUnsprung);
    UniformGrid body_first(0.02);
    const std::vector<CornerSample> expected = pairs(body_first, merged(body, wheel, 1.0));
    EXPECT_GT(expected.size(), 200u);
    for (const double bias : {0.0, 0.03, 0.3, 0.5, 0.5, 0.5, 0.97}) {
      UniformGrid grid(0.02);
      expectEqual(pairs(grid, merged(body, wheel, bias)), expected);
      for (const auto reason : {RejectReason::kNotFinite, RejectReason::kRepeatedStamp, RejectReason::kTimeWentBack})
        EXPECT_EQ(grid.streams().rejected().count(reason), body_first.streams().rejected().count(reason));
    }
  }
}

TEST_F(Interleaving, GivesSamplesInOrderOfTime) {
  UniformGrid grid(0.02);
  const std::vector<CornerSample> samples = pairs(grid, merged(stream(Side::kSprung), stream(Side::kUnsprung), 0.5));
  for (std::size_t i = 1; i < samples.size(); ++i) ASSERT_LT(samples[i - 1].stamp, samples[i].stamp);
}

TEST(UniformGrid, CountsEveryReasonToRefuseAReading) {
  UniformGrid grid(0.02);
  grid.push(Side::kSprung, at(1000), 1.0);
  grid.push(Side::kSprung, at(1020), std::nan(""));
  grid.push(Side::kSprung, at(1020), std::numeric_limits<double>::infinity());
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kNotFinite), 2u);
  grid.push(Side::kSprung, Stamp::zero(), 1.0);
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kZeroStamp), 1u);
  grid.push(Side::kSprung, at(1000), 2.0);
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kRepeatedStamp), 1u);
  grid.push(Side::kSprung, at(980), 2.0);
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kTimeWentBack), 1u);
  grid.push(Side::kUnsprung, at(1040), 2.0);
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kMissingPartner), 1u);
  EXPECT_EQ(grid.streams().rejected().total(), 6u);
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kNotMeasured), 0u);
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kTooSoon), 0u);
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
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kZeroStamp), 10u);
}

TEST(UniformGrid, RefusesAPeriodThatIsNone) {
  for (const double period : {0.0, -0.02, 1e-12, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(UniformGrid{period}, std::invalid_argument) << period;
}

/// Readings of both sensors, one every 20 ms. @return whether the sample comes.
class TwoSensors {
 public:
  bool push(double body, double wheel) {
    const Stamp stamp = at(20 * k_++);
    grid.push(Side::kSprung, stamp, body);
    return grid.push(Side::kUnsprung, stamp, wheel).has_value();
  }
  UniformGrid grid{0.02};

 private:
  int k_ = 0;
};

TEST(UniformGrid, KeepsOutWhatNoVehicleSurvivesAndWhatStandsBetween) {
  TwoSensors sensors;
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(sensors.push(9.81 + 0.01 * (k % 2), 9.0 + 0.01 * (k % 2)));
  EXPECT_TRUE(sensors.push(9.81, -900.0));  // a wheel that hits the stop
  EXPECT_FALSE(sensors.push(9.82, 1100.0));
  EXPECT_FALSE(sensors.push(9.81, 9.0));
  EXPECT_FALSE(sensors.push(9.82, 1e15));
  for (int k = 0; k < 9; ++k) EXPECT_FALSE(sensors.push(9.81 + 0.01 * (k % 2), 9.0 + 0.01 * (k % 2))) << k;
  EXPECT_TRUE(sensors.push(9.81, 9.0));
  EXPECT_EQ(sensors.grid.streams().rejected().count(RejectReason::kAbsurd), 12u);
}

// Parked, gravity taken out: the first bump is a hundred thousand times the usual.
TEST(UniformGrid, TakesTheFirstBumpOfAVehicleThatHasStoodStill) {
  TwoSensors sensors;
  for (int k = 0; k < 20000; ++k) ASSERT_TRUE(sensors.push(0.003 * std::sin(k), 0.003 * std::cos(k)));
  EXPECT_TRUE(sensors.push(50.0, 500.0));
  EXPECT_EQ(sensors.grid.streams().rejected().total(), 0u);
}

TEST(UniformGrid, TakesSensorsThatReadInAnotherUnitSoonAfterTheStart) {
  TwoSensors sensors;  // in mm/s^2
  int kept_out = 0;
  for (int k = 0; k < 1000; ++k) kept_out += sensors.push(9810.0 + k % 7, 9810.0 + 3000.0 * std::sin(k)) ? 0 : 1;
  EXPECT_LE(kept_out, 20);
}

}  // namespace
}  // namespace suspension_health_monitor
