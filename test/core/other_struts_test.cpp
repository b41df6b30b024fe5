// A strut judged alone on a body that other struts move, too: the strut turns the body, and the gyro says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "driven_mass.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {
namespace {

using Names = std::vector<std::string>;

constexpr double kRate = 100.0;
constexpr std::size_t kSamples = 6000;

/// Half a car: a body of mass 1 on two struts, 1.2 m before and 1.4 m behind its centre of gravity, whose wheels go
/// over roads of their own; integrated here by the midpoint rule. Pitch lifts the rear.
struct HalfCar {
  double inertia;     ///< Iyy/M [m^2]: 1.2 * 1.4 would leave either end alone
  double stop = 0.0;  ///< of a bump stop in front [1/s^2]

  Drive front() const {
    const BandNoise roads[] = {BandNoise(3, 0.3, 12.0, 3.0, 60), BandNoise(4, 0.3, 12.0, 3.0, 60)};
    RandomStream random(5, RandomPurpose::kSway);
    Drive drive;
    State x{};
    for (std::size_t k = 0; k < kSamples; ++k) {
      const double t = static_cast<double>(k) / kRate;
      const State slope = slopeOf(x, roads, t);
      drive.samples.push_back({fromSeconds(t), slope[1] - kFront * slope[3] + 0.03 * random.gaussian(),
                               roads[0](t) + 0.03 * random.gaussian()});
      drive.body.push_back({drive.samples.back().stamp, {0.0, 0.0}, {0.0, x[3] + 0.001 * random.gaussian()}});
      constexpr int kSteps = 10;
      constexpr double h = 1.0 / kRate / kSteps;
      for (int i = 0; i < kSteps; ++i) {
        const State there = moved(x, h / 2, slopeOf(x, roads, t + i * h));
        x = moved(x, h, slopeOf(there, roads, t + (i + 0.5) * h));
      }
    }
    return drive;
  }

 private:
  static constexpr double kFront = 1.2, kRear = -1.4;
  using State = std::array<double, 8>;  // heave, pitch, the wheels, each with its rate

  static State moved(const State& x, double by, const State& slope) {
    State result = x;
    for (std::size_t i = 0; i < x.size(); ++i) result[i] += by * slope[i];
    return result;
  }

  State slopeOf(const State& x, const BandNoise* roads, double t) const {
    const auto force = [&](double place, std::size_t wheel) {
      const double d = x[wheel] - (x[0] - place * x[2]), v = x[wheel + 1] - (x[1] - place * x[3]);
      return 3.0 * v + 30.0 * d + (place > 0.0 ? stop * std::max(0.0, d - 0.02) : 0.0);
    };
    const double front = force(kFront, 4), rear = force(kRear, 6);
    return {x[1], front + rear, x[3], -(kFront * front + kRear * rear) / inertia, x[5], roads[0](t), x[7], roads[1](t)};
  }
};

TEST(OtherStruts, OfABodyThatPitchesAreNoFaultOfASensor) {
  for (const double inertia : {1.2, 2.4, 4.0}) {
    const Diagnosis found = diagnose({HalfCar{inertia}.front()});
    ASSERT_TRUE(found) << found.reason;
    EXPECT_EQ(found.verdict, Verdict::kUnexplained) << inertia;
    EXPECT_TRUE(found.selected.empty()) << found.summary;
    EXPECT_NE(found.suggested_drive.find("other struts move the same body"), std::string::npos)
        << found.suggested_drive;
  }
}

// Nothing tells that the body pitches. What the other strut does is more than noise, and no law takes it.
TEST(OtherStruts, WithoutAGyroNameNothingEither) {
  for (const double inertia : {1.2, 1.45, 1.8, 4.0}) {
    Drive drive = HalfCar{inertia}.front();
    drive.body.clear();
    const Diagnosis found = diagnose({drive});
    ASSERT_TRUE(found) << found.reason;
    EXPECT_TRUE(found.selected.empty()) << inertia << ": " << found.summary;
  }
}

TEST(OtherStruts, ThatHardlyMoveTheTopHideNoEffect) {
  const Diagnosis found = diagnose({HalfCar{1.2 * 1.4, 60.0}.front()});
  ASSERT_TRUE(found) << found.reason;
  EXPECT_EQ(found.verdict, Verdict::kEffectFound);
  EXPECT_EQ(found.selected, Names{"bump_stop"});
}

}  // namespace
}  // namespace suspension_health_monitor
