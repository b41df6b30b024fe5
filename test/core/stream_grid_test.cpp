// Any number of streams on one clock. That of one strut, with all its rules, is uniform_grid_test.cpp.
#include "suspension_health_monitor/internal/signal/stream_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "uniform_grid.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;
constexpr int kFill = 60;

struct Message {
  std::size_t stream;
  Stamp stamp;
  double value;
};
using Streams = std::vector<std::vector<Message>>;

struct Instant {
  Stamp stamp;
  std::vector<double> values;
};

double signal(std::size_t stream, double t) {
  const double i = static_cast<double>(stream);
  return 9.81 + (1.0 + i) * std::sin(2.0 * M_PI * (3.0 + 2.0 * i) * t + i);
}

std::vector<StreamOptions> sensors(std::size_t count) {
  std::vector<StreamOptions> options;
  for (std::size_t i = 0; i < count; ++i) options.push_back({i, true});
  return options;
}

class StreamGridTest : public testing::Test {
 protected:
  struct Delivery {
    double jitter = 0.0, lost = 0.0, phase = 0.0, rate = 1.0 / kPeriod;
  };

  std::vector<Message> readings(std::size_t stream, double seconds, const Delivery& delivery) {
    std::vector<Message> messages;
    for (int k = 0; k < seconds * delivery.rate; ++k) {
      const double t = 1.0 + delivery.phase + k / delivery.rate + delivery.jitter * uniform();
      if (uniform() >= delivery.lost) messages.push_back({stream, fromSeconds(t), signal(stream, t)});
    }
    return messages;
  }

  /// In any order, but those of each stream in theirs, and none more than `lead` s ahead.
  std::vector<Message> interleaved(const Streams& streams, double lead) {
    std::vector<Message> all;
    std::vector<std::size_t> next(streams.size(), 0);
    for (;;) {
      std::vector<std::size_t> candidates;
      Stamp oldest = Stamp::max();
      for (std::size_t i = 0; i < streams.size(); ++i)
        if (next[i] < streams[i].size()) oldest = std::min(oldest, streams[i][next[i]].stamp);
      for (std::size_t i = 0; i < streams.size(); ++i)
        if (next[i] < streams[i].size() && streams[i][next[i]].stamp <= oldest + fromSeconds(lead))
          candidates.push_back(i);
      if (candidates.empty()) return all;
      const std::size_t i = candidates[static_cast<std::size_t>(uniform() * static_cast<double>(candidates.size()))];
      all.push_back(streams[i][next[i]++]);
    }
  }

  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(engine_); }

  std::mt19937_64 engine_{5};
};

std::vector<Instant> feed(StreamGrid& grid, const std::vector<Message>& messages) {
  std::vector<Instant> instants;
  for (const Message& message : messages)
    for (const GridInstant* instant = grid.push(message.stream, message.stamp, message.value); instant != nullptr;
         instant = grid.next())
      instants.push_back({instant->stamp, instant->values});
  return instants;
}

TEST_F(StreamGridTest, DoesNotDependOnTheOrderInWhichTheStreamsInterleave) {
  for (const auto& [alignment, jitter] :
       {std::pair(Alignment::kPaired, 0.003), std::pair(Alignment::kAuto, 0.003),
        std::pair(Alignment::kResampled, 0.003), std::pair(Alignment::kResampled, 0.0)}) {
    Streams streams;
    for (std::size_t i = 0; i < 5; ++i) streams.push_back(readings(i, 10.0, {jitter, 0.05, i == 3 ? 0.003 : 0.0}));
    StreamGrid in_time(kPeriod, sensors(5), alignment, kFill);
    const std::vector<Instant> expected = feed(in_time, interleaved(streams, 0.0));
    EXPECT_GT(expected.size(), 500u);
    EXPECT_EQ(in_time.resamples(), alignment != Alignment::kPaired);
    for (const double lead : {0.02, 0.3, 3.0, 30.0}) {
      StreamGrid grid(kPeriod, sensors(5), alignment, kFill);
      const std::vector<Instant> instants = feed(grid, interleaved(streams, lead));
      ASSERT_EQ(instants.size(), expected.size()) << lead;
      for (std::size_t k = 0; k < instants.size(); ++k) {
        ASSERT_EQ(instants[k].stamp, expected[k].stamp) << lead;
        ASSERT_EQ(instants[k].values, expected[k].values) << lead;
      }
      for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(grid.missed(i), in_time.missed(i)) << lead;
    }
  }
}

// The instants of three sensors are those at which either of two struts that share the first one has its pair.
TEST_F(StreamGridTest, PairsEveryStreamWithTheFirstAsAStrutOfTheTwoWould) {
  Streams streams;
  for (std::size_t i = 0; i < 3; ++i) streams.push_back(readings(i, 20.0, {0.006, 0.1}));
  StreamGrid grid(kPeriod, sensors(3), Alignment::kPaired, kFill);
  const std::vector<Instant> instants = feed(grid, interleaved(streams, 0.1));
  std::size_t found = 0;
  std::vector<std::vector<CornerSample>> pairs(3);
  for (const std::size_t partner : {1, 2}) {
    UniformGrid strut(kPeriod);
    for (const Message& message : interleaved({streams[0], streams[partner]}, 0.1)) {
      const auto sample =
          strut.push(message.stream == 0 ? Side::kSprung : Side::kUnsprung, message.stamp, message.value);
      if (sample) pairs[partner].push_back(*sample);
    }
  }
  for (const CornerSample& one : pairs[1])
    for (const CornerSample& other : pairs[2]) {
      if (one.stamp != other.stamp) continue;
      ASSERT_LT(found, instants.size());
      EXPECT_EQ(instants[found].stamp, one.stamp);
      EXPECT_EQ(instants[found].values,
                (std::vector{one.sprung_acceleration, one.unsprung_acceleration, other.unsprung_acceleration}));
      ++found;
    }
  EXPECT_EQ(found, instants.size());
  EXPECT_GT(found, 1000u);
}

TEST_F(StreamGridTest, ResamplesAllStreamsAtTheSameInstants) {
  const std::vector<double> rates{100.0, 100.0, 163.0, 400.0};
  Streams streams;
  for (std::size_t i = 0; i < rates.size(); ++i)
    streams.push_back(readings(i, 10.0, {0.002, 0.02, 0.0013 * static_cast<double>(i), rates[i]}));
  StreamGrid grid(kPeriod, sensors(rates.size()), Alignment::kAuto, kFill);
  const std::vector<Instant> instants = feed(grid, interleaved(streams, 0.1));
  ASSERT_TRUE(grid.resamples());
  ASSERT_GT(instants.size(), 800u);
  for (std::size_t k = instants.size() - 600; k < instants.size(); ++k) {
    const double t = toSeconds(instants[k].stamp);
    EXPECT_EQ(instants[k].stamp - instants[k - 1].stamp, fromSeconds(kPeriod));
    for (std::size_t i = 0; i < rates.size(); ++i)
      EXPECT_NEAR(instants[k].values[i], signal(i, t), 0.01 * (1.0 + static_cast<double>(i))) << i << " at " << t;
  }
  EXPECT_GT(grid.bridged(0), 10u);
  EXPECT_GT(grid.bridged(3), 40u);
}

TEST_F(StreamGridTest, TurnsToResamplingForOneStreamThatIsOutOfStep) {
  for (const bool out_of_step : {false, true}) {
    Streams streams;
    for (std::size_t i = 0; i < 6; ++i)
      streams.push_back(readings(i, 10.0, {0.0, 0.0, i == 4 && out_of_step ? 0.002 : 0.0}));
    StreamGrid grid(kPeriod, sensors(6), Alignment::kAuto, kFill);
    feed(grid, interleaved(streams, 0.05));
    EXPECT_EQ(describeAlignment(grid),
              out_of_step ? "resampled because the sensors read at different instants" : "paired");
  }
}

TEST_F(StreamGridTest, TellsWhichSensorLosesReadings) {
  for (const std::size_t failing : {0, 2}) {
    Streams streams;
    for (std::size_t i = 0; i < 4; ++i) streams.push_back(readings(i, 20.0, {0.0, i == failing ? 0.2 : 0.0}));
    StreamGrid grid(kPeriod, sensors(4), Alignment::kPaired, kFill);
    EXPECT_NEAR(feed(grid, interleaved(streams, 0.05)).size(), streams[failing].size(), 5);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(grid.missed(i) > 0, i == failing) << i;
      EXPECT_EQ(grid.rejected(i).count(RejectReason::kMissingPartner) > 0, i != failing) << i;
    }
  }
}

TEST_F(StreamGridTest, TellsWhichSensorIsSilentAndWhichReadsNonsense) {
  StreamGrid grid(kPeriod, sensors(3), Alignment::kPaired, kFill);
  for (int k = 0; k < static_cast<int>(kMostWaiting) + 100; ++k) {
    const Stamp stamp = k * fromSeconds(kPeriod);
    EXPECT_EQ(grid.push(0, stamp + Stamp(1), std::sin(k)), nullptr);
    EXPECT_EQ(grid.push(1, stamp + Stamp(1), std::cos(k)), nullptr);
    if (k % 2 == 0) grid.push(2, stamp + Stamp(1), std::nan(""));
  }
  EXPECT_EQ(grid.missed(0), 0u);
  EXPECT_EQ(grid.missed(2), 200u);
  EXPECT_EQ(grid.rejected(2).byName(), (std::map<std::string, std::uint64_t>{{"not_finite", 2098u}}));
  EXPECT_EQ(grid.rejected(1).byName(), (std::map<std::string, std::uint64_t>{{"missing_partner", 100u}}));
}

TEST_F(StreamGridTest, TellsWhichSensorIsSilentAfterALoss) {
  StreamGrid grid(kPeriod, sensors(2), Alignment::kResampled, kFill);
  constexpr int kLast = 1000;  // reading of the second sensor, a few after one is lost
  for (int k = 0; k < kLast + static_cast<int>(kMostWaiting) + 100; ++k) {
    const Stamp stamp = k * fromSeconds(kPeriod) + Stamp(1);
    grid.push(0, stamp, signal(0, toSeconds(stamp)));
    while (grid.next() != nullptr) {
    }
    if (k <= kLast && k != kLast - 5) grid.push(1, stamp, signal(1, toSeconds(stamp)));
  }
  EXPECT_EQ(grid.missed(0), 0u);
  EXPECT_GT(grid.missed(1), 0u);
}

// A body's IMU whose gyro reads 0 about an axis, and a wheel.
TEST_F(StreamGridTest, TakesASensorForStillOnlyIfAllItsStreamsAre) {
  const std::vector<StreamOptions> options{{0, true}, {0, true}, {1, true}};
  for (const Alignment alignment : {Alignment::kPaired, Alignment::kResampled}) {
    StreamGrid grid(kPeriod, options, alignment, kFill);
    int instants = 0;
    const auto drive = [&](int first, int last, bool stuck) {
      instants = 0;
      for (int k = first; k < last; ++k)
        for (const std::size_t stream : {0, 1, 2}) {
          const Stamp stamp = k * fromSeconds(kPeriod) + Stamp(1);
          const double value = stream == 1 ? 0.0 : stream == 0 && stuck ? 9.81 : 9.81 + std::sin(0.3 * k);
          for (auto found = grid.push(stream, stamp, value); found != nullptr; found = grid.next()) ++instants;
        }
    };
    drive(0, 200, false);
    EXPECT_GE(instants, 184);
    EXPECT_EQ(grid.rejected().total(), 0u);
    drive(200, 300, true);
    EXPECT_NEAR(instants, 19, 9);
    EXPECT_NEAR(grid.rejected(0).count(RejectReason::kStuck), 81, 9);
    EXPECT_EQ(grid.rejected(1).count(RejectReason::kStuck), grid.rejected(0).count(RejectReason::kStuck));
    EXPECT_EQ(grid.rejected(2).total(), 0u);
  }
}

// Two accelerometers, and an actuator that is off for long, then pulls at its limit, in newtons.
TEST_F(StreamGridTest, TakesAForceAtRestOrAtItsLimitForWhatItIs) {
  const std::vector<StreamOptions> options{{0, true}, {1, true}, {2, true, true}};
  for (const Alignment alignment : {Alignment::kPaired, Alignment::kResampled}) {
    StreamGrid grid(kPeriod, options, alignment, kFill);
    int instants = 0;
    constexpr int kLast = 3000;
    for (int k = 0; k < kLast; ++k)
      for (const std::size_t stream : {0, 1, 2}) {
        const Stamp stamp = k * fromSeconds(kPeriod) + Stamp(1);
        const double pull = k < 1000 ? 0.0 : std::min(4000.0, 5000.0 * std::sin(0.01 * k));
        const double value = stream == 2 ? pull : 9.81 + std::sin(0.3 * k + stream);
        for (auto found = grid.push(stream, stamp, value); found != nullptr; found = grid.next()) ++instants;
      }
    EXPECT_GE(instants, kLast - 20);
    EXPECT_EQ(grid.rejected().total(), 0u);
    // Nor does a force that moves make a vehicle at rest stuck.
    for (int k = kLast; k < 2 * kLast; ++k)
      for (const std::size_t stream : {0, 1, 2})
        for (auto found = grid.push(stream, k * fromSeconds(kPeriod) + Stamp(1), stream == 2 ? k : 9.81);
             found != nullptr; found = grid.next())
          ++instants;
    EXPECT_EQ(grid.rejected().count(RejectReason::kStuck), 0u);
  }
}

TEST_F(StreamGridTest, DoesWithoutStreamsThatAreNotRequired) {
  const std::vector<StreamOptions> options{{0, false}, {1, true}, {2, true}, {3, false}};
  for (const Alignment alignment : {Alignment::kPaired, Alignment::kResampled}) {
    StreamGrid grid(kPeriod, options, alignment, kFill);
    int instants = 0;
    std::vector<int> measured(4, 0);
    for (int k = 0; k < 400; ++k)
      for (const std::size_t stream : {3, 2, 1, 0}) {
        if (stream == 0 && k >= 200) continue;  // from here on it is silent
        if (stream == 3) continue;              // always
        const Stamp stamp = k * fromSeconds(kPeriod) + Stamp(1);
        for (auto found = grid.push(stream, stamp, signal(stream, toSeconds(stamp))); found != nullptr;
             found = grid.next()) {
          ++instants;
          for (std::size_t i = 0; i < 4; ++i) measured[i] += found->measured[i] ? 1 : 0;
          const double expected = signal(0, toSeconds(found->stamp));
          EXPECT_NEAR(found->measured[0] ? found->values[0] : expected, expected, 0.02);
        }
      }
    EXPECT_GE(instants, 380);
    EXPECT_NEAR(measured[0], 200, 20);
    EXPECT_EQ(measured[1], instants);
    EXPECT_EQ(measured[2], instants);
    EXPECT_EQ(measured[3], 0);
  }
}

TEST_F(StreamGridTest, RefusesAPeriodThatIsNoneAndStreamsOfWhichNoneIsRequired) {
  EXPECT_THROW(StreamGrid(0.0, sensors(2), Alignment::kAuto, kFill), std::invalid_argument);
  EXPECT_THROW(StreamGrid(kPeriod, {}, Alignment::kAuto, kFill), std::invalid_argument);
  EXPECT_THROW(StreamGrid(kPeriod, {{0, false}, {1, false}}, Alignment::kAuto, kFill), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
