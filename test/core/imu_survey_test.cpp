#include "suspension_health_monitor/internal/vehicle/imu_survey.h"

#include <gtest/gtest.h>

#include <random>

#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr Stamp kPeriod{10'000'000};
constexpr double kNoise = 0.05;  // [m/s^2]

/// White noise about gravity, for a minute.
/// @param up  what gravity reads [m/s^2].  @param lost  share of readings that are, by chance.
ImuSurvey survey(const Eigen::Vector3d& up, double lost = 0.0) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, kNoise);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  ImuSurvey imu;
  for (int i = 1; i <= 6000; ++i) {
    const Eigen::Vector3d reading = up + Eigen::Vector3d(noise(random), noise(random), noise(random));
    if (chance(random) >= lost) imu.add(i * kPeriod, reading);
  }
  return imu;
}

TEST(ImuSurvey, TellsRateNoiseAndGravity) {
  const ImuSurvey imu = survey({0.0, -9.81, 0.0});
  EXPECT_NEAR(imu.rate(), 100.0, 1e-6);
  EXPECT_NEAR(imu.jitter(), 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(imu.lost(), 0.0);
  EXPECT_NEAR(imu.noise(1), kNoise, 0.05 * kNoise);  // of 6000 values that overlap by eight
  const auto gravity = imu.gravity();
  ASSERT_TRUE(gravity);
  EXPECT_EQ(gravity->axis, 1);
  EXPECT_TRUE(gravity->is_negative);
  EXPECT_NEAR(gravity->size, 9.81, 0.01);
  EXPECT_NEAR(gravity->lean, 0.0, 0.001);
  EXPECT_EQ(describeFault(imu, 1, 1.0), "");
}

TEST(ImuSurvey, LeansFromTheAxisThatIsNearest) {
  const double angle = 0.4;
  const auto gravity = survey({9.81 * std::cos(angle), 0.0, 9.81 * std::sin(angle)}).gravity();
  ASSERT_TRUE(gravity);
  EXPECT_EQ(gravity->axis, 0);
  EXPECT_NEAR(gravity->lean, angle, 0.001);
}

// Of 6000 readings the share is known to 0.004.
TEST(ImuSurvey, CountsWhatIsMissing) { EXPECT_NEAR(survey({0.0, 0.0, 9.81}, 0.1).lost(), 0.1, 0.02); }

TEST(ImuSurvey, FaultsHaveTheirSentence) {
  EXPECT_NE(describeFault(survey({0.0, 0.0, 9.81}, 0.1), 2, 1.0).find("of the readings are missing"),
            std::string::npos);
  EXPECT_NE(describeFault(survey({0.0, 0.0, 0.5}), 2, 0.01).find("noise"), std::string::npos);  // gravity is taken off
  EXPECT_NE(describeFault(survey({0.0, 0.0, 1.0}), 2, 1.0).find("1.00 m/s^2 instead of 9.81"), std::string::npos);
  EXPECT_NE(describeFault(survey({0.0, 0.0, 19.62}), 2, 1.0).find("19.62 m/s^2 instead of 9.81"), std::string::npos);
  EXPECT_NE(describeFault(survey({0.0, 5.0, 8.44}), 2, 1.0).find("leans by 31 degrees"), std::string::npos);
  EXPECT_NE(describeFault(ImuSurvey(), 2, 1.0).find("too few messages"), std::string::npos);
  ImuSurvey stuck;
  for (int i = 1; i <= 100; ++i) stuck.add(i * kPeriod, {0.0, 0.0, 9.81});
  EXPECT_NE(describeFault(stuck, 2, 1.0).find("stuck"), std::string::npos);
  ImuSurvey repeated;
  for (int i = 1; i <= 100; ++i) repeated.add(i / 2 * kPeriod, {0.01 * i, 0.0, 9.81});
  EXPECT_NE(describeFault(repeated, 2, 1.0).find("stamp"), std::string::npos);
}

}  // namespace
}  // namespace suspension_health_monitor
