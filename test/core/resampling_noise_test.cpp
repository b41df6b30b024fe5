#include "suspension_health_monitor/internal/identification/resampling_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.005, kSize = 3.0, kFrequency = 2 * kPi * 10.0;

ResamplingNoise noiseOfSine(double ratio_of_body) {
  ResamplingNoise noise(kPeriod, 1.0);
  for (int k = 0; k < 2004; ++k) {  // 100 oscillations
    const double t = kPeriod * k, x = kSize * std::sin(kFrequency * t);
    noise.add({fromSeconds(t), ratio_of_body * x, x}, true);
  }
  return noise;
}

// a sin(w t) has the mean square rate a^2 w^2 / 2, and sin(w T / 2) / (w T / 2) of it between samples.
TEST(ResamplingNoise, IsTheErrorOfTheTimeTimesTheRateOfTheReading) {
  ResamplingNoise noise = noiseOfSine(0.1);
  EXPECT_EQ(noise.variances(), Eigen::Vector2d::Zero());
  noise.setErrors({{0.002, 0.001}, {0.0, 0.0}});
  const double half = 0.5 * kFrequency * kPeriod, rate = kSize * kFrequency * std::sin(half) / half / std::sqrt(2.0);
  EXPECT_NEAR(std::sqrt(noise.variances()[0]), 0.002 * 0.1 * rate, 1e-3 * 0.0002 * rate);
  EXPECT_NEAR(std::sqrt(noise.variances()[1]), 0.001 * rate, 1e-3 * 0.001 * rate);
}

// A fourth difference takes (2 sin(w T / 2))^4 of a sine.
TEST(ResamplingNoise, IsWhatACubicMissesOfTheReadingsThatAreLost) {
  ResamplingNoise noise = noiseOfSine(0.1);
  noise.setErrors({{0.0, 0.0}, {0.04, 0.01}});
  const double missed = kSize * std::pow(2.0 * std::sin(0.5 * kFrequency * kPeriod), 4) / 6.0 / std::sqrt(2.0);
  EXPECT_NEAR(std::sqrt(noise.variances()[0]), 0.2 * 0.1 * missed, 1e-3 * 0.02 * missed);
  EXPECT_NEAR(std::sqrt(noise.variances()[1]), 0.1 * missed, 1e-3 * 0.1 * missed);
}

TEST(ResamplingNoise, TakesNoStepOverAGap) {
  ResamplingNoise noise(0.01, 0.99);
  noise.setErrors({{1.0, 1.0}, {1.0, 1.0}});
  for (int k = 0; k < 4; ++k) noise.add({fromSeconds(0.01 * k), 5.0, 5.0}, true);
  noise.interrupt();
  for (int k = 0; k < 5; ++k) noise.add({fromSeconds(10.0 + 0.01 * k), -5.0, 50.0}, true);
  EXPECT_EQ(noise.variances(), Eigen::Vector2d::Zero());
}

TEST(ResamplingNoise, RemembersNothingOfAVehicleThatIsParked) {
  ResamplingNoise noise = noiseOfSine(0.1);
  noise.setErrors({{0.002, 0.001}, {0.04, 0.01}});
  const Eigen::Vector2d driven = noise.variances();
  for (int k = 0; k < 1000; ++k) noise.add({fromSeconds(10.02 + kPeriod * k), 0.0, 0.0}, false);
  EXPECT_EQ(noise.variances(), driven);
}

}  // namespace
}  // namespace suspension_health_monitor
