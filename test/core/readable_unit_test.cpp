#include <gtest/gtest.h>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

TEST(ReadableUnit, ChoosesThePrefixFromTheTypicalSize) {
  EXPECT_EQ(ReadableUnit(0.021, "m")(0.0213), "21.3 mm");
  EXPECT_EQ(ReadableUnit(0.1, "m")(0.25), "250 mm");
  EXPECT_EQ(ReadableUnit(3e-5, "m")(-4.25e-5), "-42.5 um");
  EXPECT_EQ(ReadableUnit(1000.0, "m")(1500.0), "1.5 km");
  EXPECT_EQ(ReadableUnit(1.0, "m")(999.0), "999 m");
}

TEST(ReadableUnit, PlainLeavesUsualNumbersAsTheyAre) {
  EXPECT_EQ(ReadableUnit::plain(0.1, "m/s^2")(0.352), "0.352 m/s^2");
  EXPECT_EQ(ReadableUnit::plain(1e4, "m/s^2")(12345.0), "12345 m/s^2");
  EXPECT_EQ(ReadableUnit::plain(2e-4, "s")(3e-4), "300 us");
}

TEST(ReadableUnit, WritesNoMoreDigitsThanTheOthersHave) {
  const ReadableUnit rate = ReadableUnit::plain(0.5, "m/s");
  EXPECT_EQ(rate(0.0028321), "0.0028 m/s");
  EXPECT_EQ(rate(-0.3), "-0.3 m/s");
  EXPECT_EQ(rate(-1e-9), "0 m/s");
  EXPECT_EQ(ReadableUnit(0.0, "m")(0.0), "0 m");
}

}  // namespace
}  // namespace suspension_health_monitor
