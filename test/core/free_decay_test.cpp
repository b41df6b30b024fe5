#include "suspension_health_monitor/internal/fit/free_decay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace suspension_health_monitor {
namespace {

struct Bounce {
  double damping = 3.75, stiffness = 50.0;  // b1 [1/s], b0 [1/s^2]
  double rest = 3.0;                        // [s] without hands after three pushes
  double noise = 0.03;                      // [m/s^2] of both readings
};

// Body and wheel on their tyre, m/M = 0.1 and K0/M = 500 1/s^2, eight times pushed three times with about 1 m/s^2 for
// half a period of the bounce, and let go. Sampled at 100 Hz.
Drive driveOf(const Bounce& bounce, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> about(0.7, 1.3);
  std::normal_distribution<double> noise(0.0, bounce.noise);
  constexpr double kStep = 1e-3, kMassRatio = 0.1, kTyre = 500.0;
  const double period = 2.0 * M_PI / std::sqrt(bounce.stiffness);
  std::vector<double> body, wheel;
  double z = 0.0, z_rate = 0.0, w = 0.0, w_rate = 0.0;
  long steps = 0;
  const auto run = [&](double seconds, double push, double push_seconds) {
    for (double t = 0.0; t < seconds; t += kStep, ++steps) {
      const double hands = t < push_seconds ? -push * std::sin(M_PI * t / push_seconds) : 0.0;
      const double strut = bounce.damping * (w_rate - z_rate) + bounce.stiffness * (w - z);
      const double z_acceleration = strut + hands, w_acceleration = (-strut - kTyre * w) / kMassRatio;
      if (steps % 10 == 0) {
        body.push_back(9.81 + z_acceleration + noise(random));
        wheel.push_back(9.81 + w_acceleration + noise(random));
      }
      z_rate += kStep * z_acceleration;
      w_rate += kStep * w_acceleration;
      z += kStep * z_rate;
      w += kStep * w_rate;
    }
  };
  for (int round = 0; round < 8; ++round) {
    for (int push = 0; push < 3; ++push) run(period, about(random), 0.5 * period * about(random));
    run(bounce.rest, 0.0, 0.0);
  }
  return makeDrive(0.01, body, wheel);
}

double ratioOf(const Bounce& bounce) { return bounce.damping / (2.0 * std::sqrt(bounce.stiffness)); }

TEST(FreeDecay, TellsTheDampingRatioOfABodyBouncedByHand) {
  for (const double damping : {1.9, 3.75, 8.0})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Bounce bounce{damping};
      const StrutEstimate found = estimateFromFreeDecays({driveOf(bounce, seed)});
      ASSERT_TRUE(found.valid()) << damping << ", seed " << seed;
      EXPECT_NEAR(found.dampingRatio(), ratioOf(bounce), 0.1 * ratioOf(bounce)) << "seed " << seed;
      EXPECT_NEAR(found.damping_to_mass, damping, 4.0 * found.dampingAbsoluteStddev()) << "seed " << seed;
      EXPECT_NEAR(found.stiffness_to_mass, bounce.stiffness, 4.0 * found.stiffnessAbsoluteStddev()) << "seed " << seed;
    }
}

TEST(FreeDecay, AllPartsOfABounceCountWhateverBagTheyAreIn) {
  const std::vector<Drive> both{driveOf({}, 1), driveOf({}, 2)};
  EXPECT_LT(estimateFromFreeDecays(both).damping_to_mass_stddev,
            estimateFromFreeDecays({both.front()}).damping_to_mass_stddev);
}

TEST(FreeDecay, WithoutMotionNothingIsKnown) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(9.81, 0.03);
  std::vector<double> body(4000), wheel(4000);
  for (double& reading : body) reading = noise(random);
  for (double& reading : wheel) reading = noise(random);
  EXPECT_FALSE(estimateFromFreeDecays({makeDrive(0.01, body, wheel)}).valid());
}

TEST(FreeDecay, ADriveThatIsTooShortTellsNothing) {
  EXPECT_FALSE(estimateFromFreeDecays({makeDrive(0.01, {9.8, 9.9, 9.8}, {9.8, 9.7, 9.8})}).valid());
}

}  // namespace
}  // namespace suspension_health_monitor
