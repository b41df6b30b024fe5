#include "ros/recent_samples.h"

#include <gtest/gtest.h>

namespace suspension_health_monitor {
namespace {

using RecentSamples = Recent<CornerSample>;

constexpr Stamp kPeriod = std::chrono::milliseconds(10);

void push(RecentSamples& recent, int first, int last) {
  for (int i = first; i < last; ++i) recent.push({i * kPeriod, 1.0 * i, -1.0 * i});
}

std::vector<int> numbers(const std::vector<CornerSample>& samples) {
  std::vector<int> result;
  for (const CornerSample& sample : samples) {
    EXPECT_EQ(sample.unsprung_acceleration, -sample.sprung_acceleration);
    EXPECT_EQ(sample.stamp, static_cast<int>(sample.sprung_acceleration) * kPeriod);
    result.push_back(static_cast<int>(sample.sprung_acceleration));
  }
  return result;
}

TEST(RecentSamples, KeepsWhatCameBeforeItIsFullInOrder) {
  RecentSamples recent(5);
  EXPECT_TRUE(recent.newest(std::chrono::hours(1)).empty());
  push(recent, 3, 6);
  EXPECT_EQ(numbers(recent.newest(std::chrono::hours(1))), (std::vector<int>{3, 4, 5}));
}

TEST(RecentSamples, KeepsTheNewestInOrderWhereverTheRingBegins) {
  for (int last = 5; last < 20; ++last) {
    RecentSamples recent(5);
    push(recent, 0, last);
    EXPECT_EQ(numbers(recent.newest(std::chrono::hours(1))),
              (std::vector<int>{last - 5, last - 4, last - 3, last - 2, last - 1}));
  }
}

TEST(RecentSamples, CountsTheSpanByStampsAndNotBySamples) {
  RecentSamples recent(100);
  push(recent, 0, 10);
  push(recent, 50, 60);  // a gap
  EXPECT_EQ(numbers(recent.newest(2 * kPeriod)), (std::vector<int>{57, 58, 59}));
  EXPECT_EQ(numbers(recent.newest(51 * kPeriod)), (std::vector<int>{8, 9, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59}));
}

TEST(RecentSamples, BeginsAnewWhenTheClockGoesBack) {
  RecentSamples recent(100);
  push(recent, 50, 60);
  push(recent, 20, 23);
  EXPECT_EQ(numbers(recent.newest(std::chrono::hours(1))), (std::vector<int>{20, 21, 22}));
}

TEST(RecentSamples, TellsWhatIsNewerAndForgetsOnDemand) {
  RecentSamples recent(100);
  EXPECT_TRUE(recent.isNewer({}));
  push(recent, 50, 60);
  EXPECT_FALSE(recent.isNewer({59 * kPeriod, 0.0, 0.0}));
  EXPECT_TRUE(recent.isNewer({60 * kPeriod, 0.0, 0.0}));
  recent.clear();
  EXPECT_TRUE(recent.newest(std::chrono::hours(1)).empty());
  push(recent, 1, 3);
  EXPECT_EQ(numbers(recent.newest(std::chrono::hours(1))), (std::vector<int>{1, 2}));
}

}  // namespace
}  // namespace suspension_health_monitor
