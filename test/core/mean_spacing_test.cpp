// The mean spacing of samples, against time over spacings and against its forgetting.
#include "suspension_health_monitor/internal/signal/mean_spacing.h"

#include <gtest/gtest.h>

namespace suspension_health_monitor {
namespace {

constexpr Stamp kPeriod = std::chrono::milliseconds(20), kLonger = std::chrono::milliseconds(30);
constexpr double kSeconds = 0.02, kLongerSeconds = 0.03;
constexpr double kRounding = 1e-15;

/// A series that begins at this stamp, counted once: so many spacings.
void count(MeanSpacing& mean, Stamp begin, Stamp period, int spacings) {
  mean.begin(begin);
  mean.countUntil(begin + spacings * period, static_cast<std::size_t>(spacings) + 1);
}

TEST(MeanSpacing, OfNoSpacingIsNone) {
  MeanSpacing mean;
  mean.begin(kPeriod);
  mean.countUntil(kPeriod, 1);
  EXPECT_EQ(mean.weight(), 0.0);
  EXPECT_EQ(mean.mean(), 0.0);
}

// A sample of its own between two series, and the gaps around it, have no spacing.
TEST(MeanSpacing, OfTwoSeriesIsTheirTimeOverTheirSpacingsWithoutTheGap) {
  MeanSpacing mean;
  count(mean, Stamp{}, kPeriod, 10);
  count(mean, std::chrono::seconds(50), kPeriod, 0);
  count(mean, std::chrono::seconds(100), kLonger, 30);
  EXPECT_EQ(mean.weight(), 40.0);
  EXPECT_NEAR(mean.mean(), (10 * kSeconds + 30 * kLongerSeconds) / 40, kRounding);
}

TEST(MeanSpacing, DoesNotDependOnHowOftenItIsCounted) {
  MeanSpacing mean;
  mean.begin(Stamp{});
  for (int samples = 1; samples <= 101; ++samples) {
    mean.countUntil((samples - 1) * kPeriod, static_cast<std::size_t>(samples));
    mean.countUntil((samples - 1) * kPeriod, static_cast<std::size_t>(samples));  // of no new sample
  }
  mean.countUntil(100 * kPeriod + 50 * kLonger, 151);
  EXPECT_EQ(mean.weight(), 150.0);
  EXPECT_NEAR(mean.mean(), (100 * kSeconds + 50 * kLongerSeconds) / 150, kRounding);
}

// Of more than 500 spacings the newest n have n / 500 of the mean, and all of it if they are more than 500 by
// themselves.
TEST(MeanSpacing, ForgetsBeyondFiveHundred) {
  MeanSpacing mean;
  count(mean, Stamp{}, kPeriod, 450);
  count(mean, std::chrono::seconds(100), kLonger, 100);
  EXPECT_EQ(mean.weight(), 500.0);
  const double forgotten = kSeconds + 100.0 / 500.0 * (kLongerSeconds - kSeconds);
  EXPECT_NEAR(mean.mean(), forgotten, kRounding);
  count(mean, std::chrono::seconds(200), kLonger, 50);
  EXPECT_NEAR(mean.mean(), forgotten + 50.0 / 500.0 * (kLongerSeconds - forgotten), kRounding);
  count(mean, std::chrono::seconds(300), kPeriod, 700);
  EXPECT_EQ(mean.weight(), 700.0);
  EXPECT_NEAR(mean.mean(), kSeconds, kRounding);
  count(mean, std::chrono::seconds(400), kLonger, 100);
  EXPECT_EQ(mean.weight(), 500.0);
  EXPECT_NEAR(mean.mean(), forgotten, kRounding);
}

// A stamp of today in seconds has no digits for nanoseconds: only the difference is taken as seconds.
TEST(MeanSpacing, OfFarStampsIsTheSameToTheLastDigit) {
  constexpr Stamp kOdd{20000001};
  MeanSpacing here;
  count(here, Stamp{}, kOdd, 7);
  for (const Stamp far : {Stamp{1700000000123456789}, Stamp{-1700000000123456789}}) {
    MeanSpacing there;
    count(there, far, kOdd, 7);
    EXPECT_EQ(there.mean(), here.mean()) << far.count();
  }
  MeanSpacing both;  // the clock is set back by a hundred years between two series
  count(both, Stamp{1700000000123456789}, kOdd, 7);
  count(both, Stamp{-1700000000123456789}, kOdd, 7);
  EXPECT_NEAR(both.mean(), 0.020000001, kRounding);
}

}  // namespace
}  // namespace suspension_health_monitor
