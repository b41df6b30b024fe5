#include "suspension_health_monitor/internal/math/delay_line.h"

#include <gtest/gtest.h>

namespace suspension_health_monitor {
namespace {

constexpr int kLength = 5;

/// Pushes first, first + 1, ... and looks at every age after every push. What was before is 0.
void expectOnlyWhatIsPushed(DelayLine& line, int first) {
  for (int pushed = 1; pushed <= 3 * kLength; ++pushed) {
    line.push(first + pushed - 1);
    for (int lag = 0; lag < kLength; ++lag) {
      ASSERT_EQ(line.at(lag), lag < pushed ? first + pushed - 1 - lag : 0) << pushed << ' ' << lag;
      ASSERT_EQ(line.window()[kLength - 1 - lag], line.at(lag)) << pushed << ' ' << lag;
    }
    ASSERT_EQ(line.full(), pushed >= kLength) << pushed;
  }
}

TEST(DelayLine, IsReadByAge) {
  DelayLine line(kLength);
  for (int lag = 0; lag < kLength; ++lag) EXPECT_EQ(line.at(lag), 0.0);
  expectOnlyWhatIsPushed(line, 1);
}

// Wherever in its ring it stands, also past the end of it.
TEST(DelayLine, AfterResetIsAsANewOne) {
  for (int before = 0; before <= 2 * kLength + 1; ++before) {
    DelayLine line(kLength);
    for (int k = 0; k < before; ++k) line.push(-1.0);
    line.reset();
    ASSERT_FALSE(line.full()) << before;
    for (int lag = 0; lag < kLength; ++lag) ASSERT_EQ(line.at(lag), 0.0) << before << ' ' << lag;
    expectOnlyWhatIsPushed(line, 100);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
