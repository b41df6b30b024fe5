#include "suspension_health_monitor/internal/record/sampling_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "recorded_drive.h"
#include "suspension_health_monitor/internal/pi.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {
namespace {

double powerOf(double (*wheel)(int k)) {
  const DriveRecord record = recorded(
      4000, 0.01, [](int k) { return k % 7 + 0.0; }, wheel);
  return powerAtSamplingLimit({&record});
}

}  // namespace

// Of a sine the filter passes |sin(8 x) / sin(x / 2)|^2 / 16 of its power, x its distance from half the sampling rate
// in radians per sample: 16 at the limit, 0 where 8 x is a multiple of pi.
TEST(PowerAtSamplingLimit, IsThatOfTheAlternatingFilter) {
  EXPECT_NEAR(powerOf([](int k) { return k % 2 == 0 ? 1.0 : -1.0; }), 16.0, 1e-6);
  EXPECT_NEAR(powerOf([](int k) { return std::sin(kPi / 2.0 * k); }), 0.0, 1e-6);
  const double x = 0.1;
  EXPECT_NEAR(powerOf([](int k) { return std::sin((kPi - 0.1) * k); }),
              std::pow(std::sin(8.0 * x) / std::sin(x / 2.0), 2) / 16.0, 0.05);
}

TEST(PowerAtSamplingLimit, IsOneForWhiteNoise) {
  RandomStream random(1, RandomPurpose::kUnsprungNoise);
  const DriveRecord record = recorded(
      20000, 0.01, [](int k) { return k % 7 + 0.0; }, [&](int) { return random.gaussian(); });
  EXPECT_NEAR(powerAtSamplingLimit({&record}), 1.0, 0.15);  // 20000 / 16 independent values: 3 sqrt(2 * 16 / 20000)
}

}  // namespace suspension_health_monitor
