#include <gtest/gtest.h>

#include <cmath>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"

namespace suspension_health_monitor {
namespace {

constexpr double kT = 0.01;
constexpr double kShared = 10.0;  // standard deviation; that of every strut's own is 1
constexpr double kModels = 4.0;   // variance that residuals have besides
const std::vector<StrutModel> kModelsOfTwo(2, {6.0, 63.3, {}, {}});

/// Wheels at rest: what z'' reads is what the free runs leave.
/// @param late  samples by which the second strut has what both share.
StrutDrives twoStruts(std::uint64_t seed, std::size_t count, std::size_t late) {
  RandomStream random(seed, RandomPurpose::kSprungNoise);
  std::vector<double> shared(count + late);
  for (double& each : shared) each = kShared * random.gaussian();
  StrutDrives drive(2);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < 2; ++i)
      drive[i].samples.push_back({static_cast<int>(k) * fromSeconds(kT),
                                  shared[k + (i == 0 ? late : 0)] + random.gaussian(), 1e-9 * random.gaussian()});
  return drive;
}

double variance(const Drive& drive) {
  double squares = 0.0;
  for (const CornerSample& sample : drive.samples) squares += square(sample.sprung_acceleration);
  return squares / static_cast<double>(drive.samples.size());
}

// Wiener's filter of one tap: h = s^2 / (s^2 + 1 + models) leaves s^2 (1 - h)^2 + 1 + h^2.
TEST(SharedNoise, IsTakenOutAsFarAsTheOthersTellIt) {
  for (const std::size_t late : {0u, 3u}) {
    std::vector<StrutDrives> drives{twoStruts(1, 8000, late)};
    StrutDrives noise = twoStruts(2, 16000, late);
    takeSharedNoise(drives, noise, kT, kModelsOfTwo);
    const double h = square(kShared) / (square(kShared) + 1.0 + kModels);
    const double expected = square(kShared) * square(1.0 - h) + 1.0 + square(h);
    for (const Drive& strut : {drives[0][0], drives[0][1], noise[0], noise[1]})
      EXPECT_NEAR(variance(strut), expected, 0.06 * expected) << late;
  }
}

TEST(SharedNoise, LeavesAStrutsOwnForce) {
  std::vector<StrutDrives> drives{twoStruts(1, 8000, 0)}, forced = drives;
  StrutDrives noise = twoStruts(2, 16000, 0), again = noise;
  const auto force = [](Stamp stamp) { return 5.0 * std::sin(8.0 * toSeconds(stamp)); };
  for (CornerSample& sample : forced[0][0].samples) sample.sprung_acceleration += force(sample.stamp);
  takeSharedNoise(drives, noise, kT, kModelsOfTwo);
  takeSharedNoise(forced, again, kT, kModelsOfTwo);
  const std::vector<CornerSample>&with = forced[0][0].samples, &without = drives[0][0].samples;
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t k = 0; k < with.size(); ++k)
    ASSERT_NEAR(with[k].sprung_acceleration - without[k].sprung_acceleration, force(with[k].stamp), 1e-9);
}

TEST(SharedNoise, KeepsStampsAndWheels) {
  const StrutDrives before = twoStruts(1, 4000, 0);
  std::vector<StrutDrives> drives{before};
  drives[0][1].samples.erase(drives[0][1].samples.begin() + 2000, drives[0][1].samples.begin() + 2010);
  drives[0][0].samples.erase(drives[0][0].samples.begin() + 2000, drives[0][0].samples.begin() + 2010);
  StrutDrives noise = twoStruts(2, 16000, 0);
  takeSharedNoise(drives, noise, kT, kModelsOfTwo);
  const std::vector<CornerSample>& after = drives[0][0].samples;
  EXPECT_GT(after.size(), 3600u);  // what the filters reach over at the four ends is lost
  EXPECT_LT(after.size(), 3990u);
  for (const CornerSample& sample : after) {
    const auto index = static_cast<std::size_t>(std::lround(toSeconds(sample.stamp) / kT));
    ASSERT_EQ(sample.unsprung_acceleration, before[0].samples[index].unsprung_acceleration);
  }
}

TEST(SharedNoise, StaysWhereAModelRunsAway) {
  const StrutDrives before = twoStruts(1, 4000, 0);
  std::vector<StrutDrives> drives{before};
  StrutDrives noise = twoStruts(2, 4000, 0);
  takeSharedNoise(drives, noise, kT, {{6.0, 63.3, {}, {}}, {-6.0, 63.3, {}, {}}});
  EXPECT_EQ(drives[0][0].samples.size(), 4000u);
  EXPECT_EQ(drives[0][0].samples[2000].sprung_acceleration, before[0].samples[2000].sprung_acceleration);
}

TEST(StrutsOfASensor, AreAllThoseThatTheBodysImuTellsOf) {
  EXPECT_EQ(mostStrutsOfASensor({}), 0);
  EXPECT_EQ(mostStrutsOfASensor(noiseOfOwnSensors(4)), 1);
  VehicleChannels channels;
  channels.body_imu = 0;
  channels.struts = {{6, {}, Eigen::Vector3d(1.0, 0.0, 0.0)}, {7, {}, Eigen::Vector3d(-1.0, 0.0, 0.0)}};
  EXPECT_EQ(mostStrutsOfASensor(noiseOfStrutTops(channels, fromSeconds(kT), 0.1)), 2);
  channels.struts.pop_back();
  EXPECT_EQ(mostStrutsOfASensor(noiseOfStrutTops(channels, fromSeconds(kT), 0.1)), 1);
}

}  // namespace
}  // namespace suspension_health_monitor
