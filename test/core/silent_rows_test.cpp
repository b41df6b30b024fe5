#include <gtest/gtest.h>

#include "suspension_health_monitor/internal/monitor/validity_gate.h"

namespace suspension_health_monitor {
namespace {

TEST(SilentRows, EndMotionWhenThereAreSoManyAndTheFirstThatIsNotBeginsIt) {
  SilentRows rows(3);
  const auto moves = [&](double output) {
    rows.add(output);
    return rows.moves();
  };
  for (const double output : {0.0, 0.0, -1e-9, 0.0, 0.0}) EXPECT_TRUE(moves(output));
  for (int k = 0; k < 5; ++k) EXPECT_FALSE(moves(0.0));
  EXPECT_TRUE(moves(1e-9));
}

}  // namespace
}  // namespace suspension_health_monitor
