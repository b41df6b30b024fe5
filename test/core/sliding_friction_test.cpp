#include "suspension_health_monitor/internal/blocks/sliding_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace suspension_health_monitor {
namespace {

constexpr double kDamping = 4.2, kStiffness = 52.0, kFriction = 0.5, kMemory = 4.0;

SlidingFriction strut(double longest_step = 1e-3, double friction = kFriction, double damping = kDamping) {
  SlidingFriction result(longest_step, kMemory);
  result.setStrut(damping, kStiffness, friction);
  return result;
}

double rough(double t) { return 3.0 * std::sin(9.0 * t) + 2.0 * std::sin(23.0 * t + 1.0) + std::sin(51.0 * t); }

TEST(SlidingFriction, HoldsTheStrutWhereTheWheelPullsWithLessThanIt) {
  SlidingFriction friction = strut();
  friction.push(0.0, 0.0);
  // A sine of 20 rad/s and slow mean of a hundredth of it: the direction carries what the wheel's motion needs.
  for (int i = 1; i < 400; ++i) {
    const double t = 0.005 * i, wheel = 0.8 * kFriction * std::sin(20.0 * t);
    ASSERT_NEAR(friction.push(t, wheel), wheel / kFriction, 0.05) << t;
  }
}

TEST(SlidingFriction, IsAgainstTheTravelRateWhereItSlides) {
  SlidingFriction friction = strut(1e-3, 0.01);
  double slides = 0.0, samples = 0.0, x = 0.0, v = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.005 * i, direction = friction.push(t, rough(t));
    ASSERT_GE(direction, -1.0 - 1e-9);
    ASSERT_LE(direction, 1.0 + 1e-9);
    // The same strut, whose friction is too small to matter, by small steps.
    if (std::abs(v) > 0.02 && i > 400) {
      samples += 1.0;
      slides += std::abs(direction - std::copysign(1.0, v)) < 1e-6 ? 1.0 : 0.0;
    }
    for (int k = 0; k < 50; ++k) {
      v += 1e-4 * (rough(t + 1e-4 * k) - kDamping * v - kStiffness * x);
      x += 1e-4 * v;
    }
  }
  EXPECT_GT(samples, 1000.0);
  EXPECT_GT(slides, 0.98 * samples);
}

// Without a damper. Steps that are implicit lose energy besides, so they are made small.
TEST(SlidingFriction, BringsAFreeStrutToRestInSwingsThatLoseTwoFOverB0Each) {
  const double natural = std::sqrt(kStiffness), half_swing = M_PI / natural;
  SlidingFriction friction = strut(1e-5, kFriction, 1e-9);
  friction.push(0.0, 0.0);
  // A kick that leaves the rate at v0: half swings then end at v0 / natural - (2 n - 1) f / b0, about.
  const double v0 = 1.0, h = 0.001;
  double kick_left = v0, time = 0.0, last = 0.0;
  std::vector<double> turns;
  for (int i = 1; i < 8000; ++i) {
    time += h;
    const double wheel = kick_left > 0.0 ? 50.0 : 0.0;
    kick_left -= wheel * h;
    const double direction = friction.push(time, wheel);
    if (last * direction < 0.0 && std::abs(direction) > 0.99) turns.push_back(time);
    if (std::abs(direction) > 0.99) last = direction;
  }
  // The amplitude falls from v0 / natural = 0.139 by 2 f / b0 = 0.0192 a half swing: seven of them at most.
  ASSERT_GE(turns.size(), 5u);
  EXPECT_LE(turns.size(), static_cast<std::size_t>(std::ceil(v0 / natural / (2.0 * kFriction / kStiffness))));
  for (std::size_t i = 1; i < turns.size(); ++i) EXPECT_NEAR(turns[i] - turns[i - 1], half_swing, 0.02 * half_swing);
  EXPECT_LT(std::abs(friction.push(time + h, 0.0)), 1.0);  // it sticks at the end
}

TEST(SlidingFriction, ChangesLittleWithAFinerStep) {
  SlidingFriction coarse = strut(5e-4), fine = strut(5e-5);
  double apart = 0.0, motion = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.005 * i, a = coarse.push(t, rough(t)), b = fine.push(t, rough(t));
    apart += (a - b) * (a - b);
    motion += b * b;
  }
  EXPECT_LT(std::sqrt(apart / motion), 0.05);
}

TEST(SlidingFriction, IsDeafToAnOffset) {
  SlidingFriction plain = strut(), moved = strut();
  double apart = 0.0;
  for (int i = 0; i < 8000; ++i) {
    const double t = 0.005 * i, a = plain.push(t, rough(t)), b = moved.push(t, rough(t) + 9.81);
    apart = std::max(apart, std::abs(a - b));
  }
  EXPECT_LT(apart, 1e-6);
}

TEST(SlidingFriction, DependsOnNoUnit) {
  SlidingFriction one = strut(), other(1e-3 / 16.0, kMemory / 16.0);
  other.setStrut(16.0 * kDamping, 256.0 * kStiffness, 1000.0 * kFriction);
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.005 * i, wheel = rough(t);
    ASSERT_NEAR(one.push(t, wheel), other.push(t / 16.0, 1000.0 * wheel), 1e-6) << t;
  }
}

TEST(SlidingFriction, BeginsAtRestAfterAGapAndAfterARestart) {
  SlidingFriction once = strut(), again = strut();
  for (int i = 0; i < 100; ++i) again.push(0.005 * i, rough(0.005 * i));
  EXPECT_EQ(again.push(10.0, rough(10.0)), 0.0);
  once.push(10.0, rough(10.0));
  for (int i = 1; i < 100; ++i)
    ASSERT_EQ(again.push(10.0 + 0.005 * i, rough(10.0 + 0.005 * i)),
              once.push(10.0 + 0.005 * i, rough(10.0 + 0.005 * i)));
  again.restart();
  EXPECT_EQ(again.push(1.0, rough(1.0)), 0.0);
}

}  // namespace
}  // namespace suspension_health_monitor
