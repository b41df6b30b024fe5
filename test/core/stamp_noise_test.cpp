#include "suspension_health_monitor/internal/identification/stamp_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

// a sin(w t) has the mean square rate a^2 w^2 / 2, and sin(w T / 2) / (w T / 2) of it between samples.
TEST(StampNoise, IsTheErrorOfTheStampTimesTheRateOfTheReading) {
  constexpr double kPeriod = 0.005, kSize = 3.0, kFrequency = 2 * kPi * 10.0;
  StampNoise noise(kPeriod, 1.0);
  for (int k = 0; k < 2000; ++k) {  // 100 oscillations
    const double t = kPeriod * k, x = kSize * std::sin(kFrequency * t);
    noise.add({fromSeconds(t), 0.1 * x, x});
  }
  EXPECT_EQ(noise.variances(), Eigen::Vector2d::Zero());
  noise.setStamps({0.002, 0.001});
  const double half = 0.5 * kFrequency * kPeriod, rate = kSize * kFrequency * std::sin(half) / half / std::sqrt(2.0);
  EXPECT_NEAR(std::sqrt(noise.variances()[0]), 0.002 * 0.1 * rate, 1e-3 * 0.0002 * rate);
  EXPECT_NEAR(std::sqrt(noise.variances()[1]), 0.001 * rate, 1e-3 * 0.001 * rate);
}

TEST(StampNoise, TakesNoStepOverAGap) {
  StampNoise noise(0.01, 0.99);
  noise.setStamps({1.0, 1.0});
  noise.add({fromSeconds(0.0), 5.0, 5.0});
  noise.interrupt();
  noise.add({fromSeconds(10.0), -5.0, 50.0});
  EXPECT_EQ(noise.variances(), Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace suspension_health_monitor
