#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "paper_free_run.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/model/free_run.h"

namespace suspension_health_monitor {
namespace {

ActiveEffect active(const char* name, double coefficient, std::vector<double> shapes = {}) {
  return {findEffect(forceEffects(), name), coefficient, std::move(shapes)};
}

// A strut with effects, integrated in steps so small that straight lines between values of the input will do.
class FineStrut {
 public:
  explicit FineStrut(StrutModel model) : model_(std::move(model)) {}

  template <class Input>
  double forceAt(double time, const Input& wheel_acceleration) {
    constexpr double kStep = 1e-4;
    for (; time_ < time - kStep / 2; time_ += kStep) {
      const double middle = wheel_acceleration(time_ + kStep / 2);
      const double velocity = kStep * middle;
      const WheelStep wheel{kStep * velocity / 8, velocity / 2, kStep * velocity / 2, velocity};
      integrateStrut(model_, time_, kStep, wheel, state_);
    }
    return model_.force(state_.travel, state_.travel_rate, time_, state_.memory.data());
  }
  const StrutState& state() const { return state_; }

 private:
  StrutModel model_;
  StrutState state_;
  double time_ = 0.0;
};

TEST(FreeRun, FollowsAStrutWithEffectsAsIfThereWereNoGravity) {
  const std::vector<ActiveEffect> effects{active("progressive_spring", 3000.0, {3.0}),
                                          active("asymmetric_damping", 0.8), active("hysteresis", 0.5, {0.01}),
                                          active("damping_drift", 0.02)};
  const auto wheel = [](double t) { return 1.5 * std::sin(4.0 * t) + 2.0 * std::sin(23.0 * t + 1.0); };
  FineStrut truth({kPaperB1, kPaperB0, effects, {}});
  FreeRun run(kPaperPeriod);
  EXPECT_TRUE(run.trySetModel(kPaperB1, kPaperB0));
  run.setEffects(effects);
  for (int k = 0; k < 4000; ++k) {
    const double t = k * kPaperPeriod;
    const std::optional<double> predicted = run.push(wheel(t) + 9.81, t);
    if (!predicted) continue;
    const double expected = truth.forceAt((k - FreeRun::kDelay) * kPaperPeriod, wheel);
    if (k < 3000) continue;
    // The mean of w'' is known to about max w' / 60 s = 0.008 m/s^2: 0.6 mm of travel that the effects see.
    ASSERT_NEAR(*predicted, 9.81 + expected, 0.03) << "sample " << k;
    ASSERT_NEAR(run.travel(), truth.state().travel, 2e-3);
    for (std::size_t j = 0; j < effects.size(); ++j) {
      const double force = effects[j].effect.force(
          {run.travel(), run.travelRate(), t - FreeRun::kDelay * kPaperPeriod, truth.state().memory[j]},
          effects[j].shapes.data());
      ASSERT_NEAR(run.effectForces()[j], force, 0.05 + 1e-9) << effects[j].effect.name;
    }
  }
}

TEST(FreeRun, LinearPartDoesNotFeelThatTheMeanIsStillUnsure) {
  FreeRun plain = paperFreeRun(), centred = paperFreeRun();
  centred.setEffects({active("asymmetric_spring", 0.0)});
  for (int k = 0; k < 2000; ++k) {
    const double input = 9.81 + std::sin(0.05 * k) + 0.3 * std::cos(0.4 * k);
    const std::optional<double> expected = plain.push(input), predicted = centred.push(input);
    ASSERT_EQ(predicted.has_value(), expected.has_value());
    if (k > 500) {
      ASSERT_NEAR(*predicted, *expected, 1e-5);
    }
  }
}

TEST(FreeRun, GoesOnWhenEffectsComeAndGo) {
  FreeRun run = paperFreeRun(), untouched = paperFreeRun();
  std::optional<double> predicted, expected;
  for (int k = 0; k < 1500; ++k) {
    if (k == 500) run.setEffects({active("quadratic_damping", 0.0)});
    if (k == 1000) run.setEffects({});
    predicted = run.push(9.81 + std::sin(0.1 * k));
    expected = untouched.push(9.81 + std::sin(0.1 * k));
    if (expected) {
      ASSERT_NEAR(*predicted, *expected, 10.0 * kPaperStepError) << k;
    }
  }
  EXPECT_NEAR(run.travel(), untouched.travel(), kPaperStepError);
  EXPECT_TRUE(run.settled());
}

TEST(FreeRun, ThatRunsAwayStartsAnewAndCounts) {
  FreeRun run = paperFreeRun();
  run.setEffects({active("asymmetric_spring", 0.0), active("quadratic_damping", -50.0)});  // feeds the motion
  double largest = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const std::optional<double> predicted = run.push(std::sin(0.1 * k) + 9.81);
    if (predicted) largest = std::max(largest, std::abs(*predicted));
  }
  EXPECT_GT(run.runaways(), 1u);
  EXPECT_LE(largest, 1e3 * 10.81);
  run.setCoefficient(1, 5.0);
  const std::uint64_t before = run.runaways();
  for (int k = 0; k < 1000; ++k) run.push(std::sin(0.1 * k) + 9.81);
  EXPECT_EQ(run.runaways(), before);
  EXPECT_TRUE(run.settled());
}

// Their sum is small, but each has a column of its own in the regression.
TEST(FreeRun, RunsAwayWhereEffectsThatCancelHaveForcesThatNoColumnCanHold) {
  for (const double force : {1e30, 1e100}) {
    FreeRun run = paperFreeRun();
    std::vector<ActiveEffect> effects{active("asymmetric_spring", 2.0), active("quadratic_damping", -2.0)};
    for (ActiveEffect& one : effects) one.effect.force = [force](const StrutMotion&, const double*) { return force; };
    run.setEffects(effects);
    bool predicted = false;
    for (int k = 0; k < 200; ++k) predicted = run.push(std::sin(0.1 * k)).has_value() || predicted;
    EXPECT_EQ(predicted, force < 1e60);
    EXPECT_EQ(run.runaways() == 0u, force < 1e60);
  }
}

TEST(FreeRun, RefusesEffectsThatItCannotHold) {
  FreeRun run = paperFreeRun();
  const std::vector<ActiveEffect> many(kMostEffects + 1, active("asymmetric_spring", 1.0));
  EXPECT_THROW(run.setEffects(many), std::invalid_argument);
  EXPECT_THROW(run.setEffects({active("bump_stop", 1.0)}), std::invalid_argument);
  EXPECT_THROW(run.setEffects({active("bump_stop", std::nan(""), {0.1})}), std::invalid_argument);
  EXPECT_TRUE(run.model().effects.empty());
}

}  // namespace
}  // namespace suspension_health_monitor
