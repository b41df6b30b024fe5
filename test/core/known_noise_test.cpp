#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {
namespace {

constexpr double kT = 0.01;
const StrutModel kStrut{6.0, 63.3, {}, {}};

/// A wheel at rest: what z'' reads is what the free run leaves.
std::vector<CornerSample> readings(std::size_t count, const std::function<double(std::size_t)>& sprung) {
  RandomStream wheel(5, RandomPurpose::kUnsprungNoise);
  std::vector<CornerSample> samples;
  for (std::size_t k = 0; k < count; ++k)
    samples.push_back({static_cast<int>(k) * fromSeconds(kT), sprung(k), 1e-9 * wheel.gaussian()});
  return samples;
}

/// White noise after a difference, as that of a gyro: of twice the variance.
std::function<double(std::size_t)> differences(int seed, double size) {
  return [random = RandomStream(seed, RandomPurpose::kGyroNoise), size, last = 0.0](std::size_t) mutable {
    const double before = last;
    last = size * random.gaussian();
    return last - before;
  };
}

double floorOf(const std::vector<CornerSample>& samples) {
  Drive drive{samples};
  drive.noise = readings(16000, differences(2, 1.0));
  const DriveRecord record(drive, kT);
  return floorOfKnownNoise({&record}, kStrut);
}

TEST(FloorOfKnownNoise, IsTheSizeOfTheNoise) {
  for (const double size : {0.003, 0.3})
    EXPECT_NEAR(floorOf(readings(12000, differences(1, size))), std::sqrt(2.0) * size, 0.04 * size);
}

// Several times as strong as the noise, but slow.
TEST(FloorOfKnownNoise, IsNotThatOfALawThatTheModelLacks) {
  auto noise = differences(1, 0.1);
  RandomStream random(3, RandomPurpose::kSprungNoise);
  double slow = 0.0, slower = 0.0;
  const auto both = [&](std::size_t k) {
    slow += 0.05 * (random.gaussian() - slow);  // ends at 0.8 Hz
    slower += 0.05 * (slow - slower);
    return noise(k) + 10.0 * slower;
  };
  EXPECT_NEAR(floorOf(readings(12000, both)), std::sqrt(2.0) * 0.1, 0.02);
}

TEST(FloorOfKnownNoise, IsNotKnownFromAShortDrive) { EXPECT_EQ(floorOf(readings(150, differences(1, 0.1))), 0.0); }

}  // namespace
}  // namespace suspension_health_monitor
