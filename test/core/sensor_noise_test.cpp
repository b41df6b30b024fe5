#include <gtest/gtest.h>

#include <cmath>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/signal/filters.h"
#include "suspension_health_monitor/internal/signal/white_level.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"

namespace suspension_health_monitor {
namespace {

constexpr Stamp kPeriod = std::chrono::milliseconds(10);
constexpr double kT = 0.01;

double rms(const Drive& drive, double CornerSample::*signal) {
  double squares = 0.0;
  for (const CornerSample& sample : drive.samples) squares += std::pow(sample.*signal, 2);
  return std::sqrt(squares / static_cast<double>(drive.samples.size()));
}

VehicleChannels bodyImuWithTops(const std::vector<Eigen::Vector3d>& tops) {
  VehicleChannels channels;
  channels.body_imu = 0;
  for (std::size_t i = 0; i < tops.size(); ++i) channels.struts.push_back({6 + i, {}, tops[i]});
  return channels;
}

TEST(SensorNoise, OfOwnSensorsIsWhiteAndIndependent) {
  const StrutDrives drive = makeNoiseDrive(noiseOfOwnSensors(2), kT);
  ASSERT_EQ(drive.size(), 2u);
  const auto count = static_cast<double>(drive.front().samples.size());
  double shared = 0.0, later = 0.0;
  for (std::size_t k = 1; k < drive.front().samples.size(); ++k) {
    shared += drive[0].samples[k].sprung_acceleration * drive[1].samples[k].sprung_acceleration / count;
    later += drive[0].samples[k].sprung_acceleration * drive[0].samples[k - 1].sprung_acceleration / count;
  }
  const double most = 4.0 / std::sqrt(count);
  for (const Drive& strut : drive) {
    EXPECT_NEAR(rms(strut, &CornerSample::sprung_acceleration), 1.0, most);
    EXPECT_NEAR(rms(strut, &CornerSample::unsprung_acceleration), 1.0, most);
  }
  EXPECT_NEAR(shared, 0.0, most);
  EXPECT_NEAR(later, 0.0, most);
}

// Two tops, one ahead of the body's IMU and one behind: the accelerometer's noise is theirs alike, the gyro's opposite.
TEST(SensorNoise, OfABodysImuIsSharedByItsTops) {
  for (const double gyro_noise : {0.0, 10.0}) {
    const VehicleChannels channels = bodyImuWithTops({{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}});
    const StrutDrives drive = makeNoiseDrive(noiseOfStrutTops(channels, kPeriod, gyro_noise), kT);
    double product = 0.0, square = 0.0;
    for (std::size_t k = 0; k < drive[0].samples.size(); ++k) {
      product += drive[0].samples[k].sprung_acceleration * drive[1].samples[k].sprung_acceleration;
      square += std::pow(drive[0].samples[k].sprung_acceleration, 2);
    }
    EXPECT_NEAR(product / square, gyro_noise == 0.0 ? 1.0 : -1.0, 0.01) << gyro_noise;
  }
}

// Parseval: white noise that is differentiated up to f0 has the variance (2 pi)^2 f0^3 / 3 over half the rate; the
// filter's transition lies between its ends.
TEST(SensorNoise, OfAGyroGrowsWithTheFrequency) {
  const VehicleChannels channels = bodyImuWithTops({{2.0, 0.0, 0.0}});
  const StrutDrives drive = makeNoiseDrive(noiseOfStrutTops(channels, kPeriod, 100.0), kT);
  const MotionFilter filter(kPeriod, 1, 1);
  const auto expected = [](double end) {
    return 100.0 * 2.0 * 2.0 * M_PI * std::sqrt(end * end * end / 3.0 / (0.5 / kT));
  };
  EXPECT_GT(rms(drive[0], &CornerSample::sprung_acceleration), expected(filter.flat()));
  EXPECT_LT(rms(drive[0], &CornerSample::sprung_acceleration), expected(filter.stop()));
}

TEST(SensorNoise, LeavesOutTheBodysImuWhereNoStrutNeedsIt) {
  VehicleChannels channels;
  channels.struts = {{0, 1, Eigen::Vector3d::Zero()}, {2, 3, Eigen::Vector3d::Zero()}};
  const SensorNoise noise = noiseOfStrutTops(channels, kPeriod, 1.0);
  ASSERT_EQ(noise.size(), 4u);
  for (const StrutDrives& response : noise) EXPECT_EQ(response.front().samples.size(), 1u);
}

// The level of noise is found beside a motion that is a thousand times as large.
TEST(WhiteLevel, IsThatOfTheNoise) {
  WhiteLevel level(1.0);
  RandomStream random(3, RandomPurpose::kSprungNoise);
  for (int k = 0; k < 20000; ++k) level.add(30.0 * std::sin(2.0 * M_PI * 1.5 * kT * k) + 0.03 * random.gaussian());
  EXPECT_NEAR(level.deviation(), 0.03, 0.03 * 0.05);
}

}  // namespace
}  // namespace suspension_health_monitor
