// A stream that stops while others go on is silent, from when to when; nobody is where all of them stop.
#include "suspension_health_monitor/internal/signal/stream_silence.h"

#include <gtest/gtest.h>

#include <chrono>
#include <initializer_list>
#include <string>
#include <vector>

namespace suspension_health_monitor {
namespace {

constexpr Stamp kTimeout = std::chrono::seconds(2), kPeriod = std::chrono::milliseconds(100);

class StreamSilenceTest : public ::testing::Test {
 protected:
  /// Readings of some streams every kPeriod, from `from` up to but without `to` [s].
  void drive(double from, double to, std::initializer_list<std::size_t> streams) {
    for (Stamp stamp = fromSeconds(from); stamp < fromSeconds(to); stamp += kPeriod)
      for (const std::size_t stream : streams) silence_.add(stream, stamp);
  }

  void expectOne(std::size_t stream, double from, double to) const {
    ASSERT_EQ(ended_.size(), 1U);
    EXPECT_EQ(ended_[0].stream, stream);
    EXPECT_NEAR(toSeconds(ended_[0].from), from, 1e-9);
    EXPECT_NEAR(toSeconds(ended_[0].to), to, 1e-9);
  }

  std::vector<StreamSilence::Silence> ended_;
  StreamSilence silence_{
      {"a", "b", "c"}, kTimeout, [this](const StreamSilence::Silence& ended) { ended_.push_back(ended); }};
};

TEST_F(StreamSilenceTest, OneThatEndsIsSilentToTheEnd) {
  drive(10.0, 60.0, {0, 1, 2});
  drive(60.0, 120.05, {0, 2});
  EXPECT_NEAR(toSeconds(silence_.lasting(1)), 120.0 - 59.9, 1e-9);
  EXPECT_EQ(silence_.lasting(0), Stamp::zero());
  EXPECT_TRUE(ended_.empty());
  silence_.finish();
  expectOne(1, 59.9, 120.0);
}

TEST_F(StreamSilenceTest, OneWithAHoleIsSilentUntilItComesAgain) {
  drive(10.0, 60.0, {0, 1, 2});
  drive(60.0, 70.0, {0, 1});
  drive(70.0, 80.0, {0, 1, 2});
  expectOne(2, 59.9, 70.0);
  EXPECT_EQ(silence_.lasting(2), Stamp::zero());
}

TEST_F(StreamSilenceTest, OneThatBeginsLateIsSilentFromTheFirstReadingOfAnother) {
  drive(10.0, 20.0, {0, 1});
  drive(20.0, 30.0, {0, 1, 2});
  silence_.finish();
  expectOne(2, 10.0, 20.0);
}

TEST_F(StreamSilenceTest, NamesThoseOfNowAndOfLate) {
  using Names = std::vector<std::string>;
  drive(10.0, 20.0, {0, 1, 2});
  drive(20.0, 30.0, {1});
  EXPECT_EQ(silence_.now(), (Names{"a", "c"}));
  drive(30.0, 31.0, {0, 1});
  EXPECT_EQ(silence_.now(), (Names{"c"}));
  EXPECT_EQ(silence_.ofLate(), (Names{"a", "c"}));
  silence_.forget();
  EXPECT_EQ(silence_.ofLate(), (Names{"c"}));
  silence_.finish();
  EXPECT_TRUE(silence_.now().empty());
  EXPECT_EQ(silence_.ofLate(), (Names{"c"}));
}

TEST_F(StreamSilenceTest, APauseNoLongerThanTheTimeoutIsNone) {
  drive(10.0, 20.0, {0, 1, 2});
  drive(20.0, 21.9, {0, 1});
  drive(21.9, 30.0, {0, 1, 2});
  silence_.finish();
  EXPECT_TRUE(ended_.empty());
}

TEST_F(StreamSilenceTest, NobodyIsSilentWhereAllPauseNorWhereTheClockJumps) {
  drive(10.0, 20.0, {0, 1, 2});
  drive(50.0, 60.0, {2, 0, 1});
  drive(5.0, 15.0, {1, 2, 0});
  for (const double wild : {0.0, 4e9}) {
    silence_.add(1, fromSeconds(wild));
    drive(15.0 + wild * 1e-9, 25.0, {0, 1, 2});
  }
  silence_.finish();
  drive(1000.0, 1010.0, {1, 0, 2});
  silence_.finish();
  EXPECT_TRUE(ended_.empty());
}

TEST_F(StreamSilenceTest, AClockThatJumpsEndsASilenceThatIsLongEnough) {
  drive(10.0, 20.0, {0, 1, 2});
  drive(20.0, 30.0, {0, 1});
  drive(5.0, 6.0, {0, 1});
  silence_.finish();
  expectOne(2, 19.9, 29.9);
}

TEST_F(StreamSilenceTest, ClocksThatAreFarApartMakeNobodySilent) {
  for (Stamp stamp = fromSeconds(10.0); stamp < fromSeconds(40.0); stamp += kPeriod) {
    silence_.add(0, stamp);
    silence_.add(1, stamp + fromSeconds(100.0));
    silence_.add(2, stamp - fromSeconds(5.0));
  }
  silence_.finish();
  EXPECT_TRUE(ended_.empty());
}

}  // namespace
}  // namespace suspension_health_monitor
