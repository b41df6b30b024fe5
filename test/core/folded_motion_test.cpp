#include <gtest/gtest.h>

#include <cmath>

#include "recorded_drive.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {
namespace {

const StrutModel kStrut{4.0, 40.0, {}, {}};
constexpr double kPeriod = 0.01;

template <class Wheel>
double foldedOf(const Wheel& wheel) {
  const DriveRecord record = recorded(
      20000, kPeriod, [](int k) { return k % 7 + 0.0; }, wheel);
  return foldedMotion({&record}, kStrut);
}

// |G| at half the rate, from G(s) = (b1 s + b0) / (s^2 + b1 s + b0).
double passed() {
  const double omega = M_PI / kPeriod;
  return std::hypot(40.0, 4.0 * omega) / std::hypot(40.0 - omega * omega, 4.0 * omega);
}

TEST(FoldedMotion, IsWhatTheStrutPassesOfWhiteMotion) {
  for (const double rms : {0.01, 2.0}) {
    RandomStream random(1, RandomPurpose::kUnsprungNoise);
    const double folded = foldedOf([&](int) { return rms * random.gaussian(); });
    EXPECT_NEAR(folded / (rms * passed()), 1.0, 0.06);  // a sixteenth of 20000 independent values: 2 / sqrt(1250)
  }
}

TEST(ShareAtSamplingLimit, IsOneOfWhiteMotionAndNoneOfWhatEndsBelow) {
  RandomStream random(1, RandomPurpose::kUnsprungNoise);
  const auto shareOf = [](const auto& wheel) {
    const DriveRecord record = recorded(
        20000, kPeriod, [](int k) { return k % 7 + 0.0; }, wheel);
    return shareAtSamplingLimit({&record});
  };
  EXPECT_NEAR(shareOf([&](int) { return 3.0 * random.gaussian(); }), 1.0, 0.06);
  EXPECT_LT(shareOf([](int k) { return 3.0 * std::sin(2.0 * M_PI * 0.31 * k); }), 1e-3);
}

TEST(FoldedMotion, IsNoneWhereTheWheelEndsBelowHalfTheRate) {
  const double folded = foldedOf([](int k) { return 3.0 * std::sin(2.0 * M_PI * 0.31 * k); });
  EXPECT_LT(folded, 1e-3 * passed());
}

}  // namespace
}  // namespace suspension_health_monitor
