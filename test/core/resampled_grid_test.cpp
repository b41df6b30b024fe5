#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "interleaved.h"
#include "suspension_health_monitor/internal/signal/stream_grid.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "uniform_grid.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.005;

struct Message {
  Side side;
  double time;
  double acceleration;
};

double body(double t) { return 9.81 + std::sin(2.0 * M_PI * 1.7 * t); }
double wheel(double t) { return 9.81 + 3.0 * std::sin(2.0 * M_PI * 11.0 * t + 1.0); }
double road(double t) { return 5.0 * std::sin(2.0 * M_PI * 15.0 * t + 2.0); }

double signal(Side side, double t) {
  if (side == Side::kRoad) return road(t);
  return side == Side::kSprung ? body(t) : wheel(t);
}

class Messages {
 public:
  explicit Messages(unsigned seed) : engine_(seed) {}

  /// Readings of one sensor in [from, to), late by 0..jitter.
  std::vector<Message> of(Side side, double rate, double from, double to, double jitter = 0.0, double lost = 0.0) {
    std::vector<Message> messages;
    for (int k = 0; from + k / rate < to; ++k) {
      const double t = from + k / rate + jitter * uniform();
      if (uniform() >= lost) messages.push_back({side, t, signal(side, t)});
    }
    return messages;
  }

  std::vector<Message> merged(const std::vector<Message>& a, const std::vector<Message>& b, double bias) {
    return interleaved(a, b, bias, [this] { return uniform(); });
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(engine_); }

  std::mt19937_64 engine_;
};

std::vector<Message> byTime(const std::vector<Message>& a, const std::vector<Message>& b) {
  std::vector<Message> all;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const bool take_a = j == b.size() || (i < a.size() && a[i].time <= b[j].time);
    all.push_back(take_a ? a[i++] : b[j++]);
  }
  return all;
}

std::vector<CornerSample> feed(UniformGrid& grid, const std::vector<Message>& messages) {
  std::vector<CornerSample> samples;
  for (const Message& message : messages)
    for (auto sample = grid.push(message.side, fromSeconds(message.time), message.acceleration); sample;
         sample = grid.next())
      samples.push_back(*sample);
  return samples;
}

void expectTrue(const CornerSample& sample, double tolerance = 0.02) {
  const double t = toSeconds(sample.stamp);
  EXPECT_NEAR(sample.sprung_acceleration, body(t), tolerance) << t;
  EXPECT_NEAR(sample.unsprung_acceleration, wheel(t), tolerance) << t;
}

/// Intervals between the samples, in periods, other than 1.
std::vector<double> jumps(const std::vector<CornerSample>& samples) {
  std::vector<double> all;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double periods = toSeconds(samples[i].stamp - samples[i - 1].stamp) / kPeriod;
    if (periods != 1.0) all.push_back(periods);
  }
  return all;
}

const GridOptions kResampled{Alignment::kResampled, 240};
const GridOptions kAuto{Alignment::kAuto, 240};

TEST(ResampledStreamGrid, GivesBothSensorsAtTheInstantsOfOneUniformSeries) {
  Messages messages(1);
  UniformGrid grid(kPeriod, kResampled);
  const std::vector<CornerSample> samples =
      feed(grid, byTime(messages.of(Side::kSprung, 200.0, 10.0, 15.0, 0.001, 0.02),
                        messages.of(Side::kUnsprung, 333.0, 10.0011, 15.0, 0.001, 0.02)));
  EXPECT_GT(samples.size(), 1000u - 2 * StreamResampler::kHalfWidth - 4);
  EXPECT_TRUE(jumps(samples).empty());
  for (const CornerSample& sample : samples) expectTrue(sample);
  EXPECT_GT(grid.streams().bridged(), 20u);
  EXPECT_LT(grid.streams().bridged(), 120u);  // 2 % of 2665 readings: 53
  EXPECT_EQ(grid.streams().rejected().total(), 0u);
}

TEST(ResampledStreamGrid, DoesNotDependOnTheOrderInWhichTheStreamsInterleave) {
  Messages messages(2);
  const auto sprung = messages.of(Side::kSprung, 200.0, 1.0, 4.0, 0.001, 0.1);
  const auto unsprung = messages.of(Side::kUnsprung, 333.0, 1.0, 4.0, 0.001, 0.1);
  for (const GridOptions& options : {kResampled, kAuto}) {
    UniformGrid one_first(kPeriod, options);
    const std::vector<CornerSample> expected = feed(one_first, messages.merged(sprung, unsprung, 1.0));
    EXPECT_GT(expected.size(), 400u);
    for (const double bias : {0.0, 0.05, 0.4, 0.6}) {
      UniformGrid grid(kPeriod, options);
      const std::vector<CornerSample> samples = feed(grid, messages.merged(sprung, unsprung, bias));
      ASSERT_EQ(samples.size(), expected.size());
      for (std::size_t i = 0; i < samples.size(); ++i) {
        ASSERT_EQ(samples[i].stamp, expected[i].stamp);
        ASSERT_EQ(samples[i].sprung_acceleration, expected[i].sprung_acceleration);
        ASSERT_EQ(samples[i].unsprung_acceleration, expected[i].unsprung_acceleration);
      }
    }
  }
}

TEST(ResampledStreamGrid, BridgesThreeLostReadingsAndBeginsAnewAfterMore) {
  for (const int lost : {3, 4}) {
    Messages messages(3);
    std::vector<Message> sprung = messages.of(Side::kSprung, 200.0, 1.0, 3.0);
    sprung.erase(sprung.begin() + 200, sprung.begin() + 200 + lost);
    UniformGrid grid(kPeriod, kResampled);
    const std::vector<CornerSample> samples = feed(grid, byTime(sprung, messages.of(Side::kUnsprung, 333.0, 1.0, 3.0)));
    for (const CornerSample& sample : samples) expectTrue(sample);
    EXPECT_EQ(grid.streams().bridged(), lost == 3 ? 3u : 0u);
    if (lost == 3) {
      EXPECT_TRUE(jumps(samples).empty());
    } else {  // the hole, and half a window to either side of it
      EXPECT_EQ(jumps(samples), std::vector{lost + 1.0 + 2 * StreamResampler::kHalfWidth});
    }
  }
}

TEST(ResampledStreamGrid, GoesOnAfterPausesLoopsAndSilenceOfOne) {
  Messages messages(4);
  UniformGrid grid(kPeriod, kResampled);
  const auto both = [&](double from, double to) {
    return feed(grid, byTime(messages.of(Side::kSprung, 200.0, from, to),
                             messages.of(Side::kUnsprung, 333.0, from + 0.001, to)));
  };
  EXPECT_GT(both(100.0, 102.0).size(), 375u);
  EXPECT_GT(both(160.0, 162.0).size(), 375u);  // a pause
  const std::vector<CornerSample> looped = both(100.0, 102.0);
  EXPECT_GT(looped.size(), 375u);
  for (const CornerSample& sample : looped) expectTrue(sample);
  feed(grid, messages.of(Side::kSprung, 200.0, 102.0, 202.0));  // more than the ring holds
  EXPECT_GT(grid.streams().rejected().count(RejectReason::kMissingPartner), 10000u);
  EXPECT_GT(both(202.0, 204.0).size(), 375u);
}

TEST(ResampledStreamGrid, KeepsOutASensorThatIsStuck) {
  Messages messages(5);
  std::vector<Message> unsprung = messages.of(Side::kUnsprung, 333.0, 1.0, 3.0);
  for (std::size_t i = 200; i < 400; ++i) unsprung[i].acceleration = 9.81;
  UniformGrid grid(kPeriod, kResampled);
  const std::size_t samples = feed(grid, byTime(messages.of(Side::kSprung, 200.0, 1.0, 3.0), unsprung)).size();
  const std::uint64_t stuck = grid.streams().rejected().count(RejectReason::kStuck);
  EXPECT_NEAR(static_cast<double>(stuck), 180 * 200.0 / 333.0, 2.0);  // 20 readings pass before it shows
  EXPECT_NEAR(static_cast<double>(samples + stuck), 400 - 2 * StreamResampler::kHalfWidth, 3.0);
}

TEST(ResampledStreamGrid, GivesTheRoadAtTheSameInstantsAndDoesWithoutIt) {
  Messages messages(6);
  UniformGrid grid(kPeriod, kResampled, true);
  std::vector<Message> road_readings = messages.of(Side::kRoad, 500.0, 1.0, 3.0, 0.001, 0.02);
  int with = 0, without = 0;
  for (const Message& message :
       byTime(byTime(messages.of(Side::kSprung, 200.0, 1.0, 5.0), messages.of(Side::kUnsprung, 333.0, 1.0, 5.0)),
              road_readings))
    for (auto sample = grid.push(message.side, fromSeconds(message.time), message.acceleration); sample;
         sample = grid.next()) {
      expectTrue(*sample);
      const std::optional<double> value = grid.roadAcceleration();
      ++(value ? with : without);
      EXPECT_NEAR(value.value_or(road(toSeconds(sample->stamp))), road(toSeconds(sample->stamp)), 0.03);
    }
  EXPECT_NEAR(with, 400 - 16, 4);
  EXPECT_NEAR(without, 400, 4);
}

struct Case {
  const char* words;  // of the reason; nothing: stays paired
  double rate, phase, jitter, lost;
};

TEST(AlignmentAuto, ResamplesWhenTheStampsShowThatPairingDoesBadly) {
  for (const Case& it :
       {Case{"", 200.0, 0.0, 0.0, 0.0}, Case{"", 200.0, 0.0003, 0.0, 0.0}, Case{"", 200.0, 0.0, 0.001, 0.0},
        Case{"", 200.0, 0.0, 0.0, 0.0005}, Case{"different instants", 200.0, 0.0006, 0.0, 0.0},
        Case{"different instants", 200.0, 0.0, 0.002, 0.0}, Case{"rates differ", 400.0, 0.0, 0.0, 0.0},
        Case{"lost", 200.0, 0.0, 0.0, 0.01}}) {
    Messages messages(7);
    UniformGrid grid(kPeriod, kAuto);
    const std::vector<CornerSample> samples =
        feed(grid, byTime(messages.of(Side::kSprung, 200.0, 1.0, 31.0, it.jitter, it.lost),
                          messages.of(Side::kUnsprung, it.rate, 1.0 + it.phase, 31.0, it.jitter, it.lost)));
    EXPECT_EQ(grid.streams().resamples(), *it.words != 0) << it.words;
    EXPECT_NE(describeAlignment(grid.streams()).find(it.words), std::string::npos)
        << describeAlignment(grid.streams()) << ", not " << it.words;
    EXPECT_EQ(describeAlignment(grid.streams()) == "paired", !grid.streams().resamples());
    for (std::size_t i = 1; i < samples.size(); ++i) ASSERT_LT(samples[i - 1].stamp, samples[i].stamp);
  }
}

TEST(AlignmentAuto, APauseOfBothOrASilenceOfOneIsNoReason) {
  Messages messages(8);
  UniformGrid grid(kPeriod, kAuto);
  for (int k = 0; k < 20; ++k) {
    feed(grid, byTime(messages.of(Side::kSprung, 200.0, 10.0 * k, 10.0 * k + 2.0),
                      messages.of(Side::kUnsprung, 200.0, 10.0 * k, 10.0 * k + 2.0)));
    feed(grid, messages.of(Side::kSprung, 200.0, 10.0 * k + 2.0, 10.0 * k + 3.0));
  }
  EXPECT_FALSE(grid.streams().resamples());
}

TEST(AlignmentAuto, TheSwitchIsOneGap) {
  Messages messages(9);
  UniformGrid grid(kPeriod, kAuto);
  const std::vector<CornerSample> samples = feed(
      grid, byTime(messages.of(Side::kSprung, 200.0, 1.0, 11.0), messages.of(Side::kUnsprung, 200.0, 1.001, 11.0)));
  ASSERT_TRUE(grid.streams().resamples());
  EXPECT_EQ(jumps(samples).size(), 1u);
  EXPECT_LT(jumps(samples).front(), 2.0 * StreamResampler::kHalfWidth);
  expectTrue(samples.back());
}

// 4 % lost are no reason to doubt the rate; readings that come half as often as samples are.
TEST(AlignmentAuto, NamesTheMeasuredRateWhereSamplePeriodIsTooShortAndNothingIsLost) {
  for (const double rate : {100.0, 120.0}) {
    Messages messages(8);
    UniformGrid grid(kPeriod, kAuto);
    feed(grid, byTime(messages.of(Side::kSprung, rate, 1.0, 11.0), messages.of(Side::kUnsprung, rate, 1.0, 11.0)));
    EXPECT_TRUE(grid.streams().resamples());
    EXPECT_EQ(describeAlignment(grid.streams()), "resampled because " + describeSlowReadings(grid.streams()));
    EXPECT_NE(describeAlignment(grid.streams())
                  .find(rate == 100.0 ? "every 0.01 s (100 Hz), but sample_period = 0.005" : "(120 Hz)"),
              std::string::npos)
        << describeAlignment(grid.streams());
  }
  Messages messages(9);
  UniformGrid lossy(kPeriod, kAuto);
  feed(lossy, byTime(messages.of(Side::kSprung, 200.0, 1.0, 31.0, 0.0, 0.04),
                     messages.of(Side::kUnsprung, 200.0, 1.0, 31.0, 0.0, 0.04)));
  EXPECT_EQ(describeSlowReadings(lossy.streams()), "");
  EXPECT_NE(describeAlignment(lossy.streams()).find("lost"), std::string::npos) << describeAlignment(lossy.streams());
}

}  // namespace
}  // namespace suspension_health_monitor
