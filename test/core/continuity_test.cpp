#include <gtest/gtest.h>

#include "milliseconds.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {
namespace {

TEST(Continuity, TellsSpacingsApartAtHalfAndAtThreeHalvesOfThePeriod) {
  const Stamp ns(1), period = at(20);
  EXPECT_EQ(continuity(-ns, period), Continuity::kClockJumped);
  EXPECT_EQ(continuity(Stamp::zero(), period), Continuity::kTooSoon);
  EXPECT_EQ(continuity(at(10), period), Continuity::kTooSoon);
  EXPECT_EQ(continuity(at(10) + ns, period), Continuity::kContinues);
  EXPECT_EQ(continuity(at(30) - ns, period), Continuity::kContinues);
  EXPECT_EQ(continuity(at(30), period), Continuity::kGap);
}

}  // namespace
}  // namespace suspension_health_monitor
