#include "suspension_health_monitor/model/free_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "suspension_health_monitor/model/effect_catalogue.h"
#include "suspension_health_monitor/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 3.0;       // [1/s]
constexpr double kB0 = 13.8;      // [1/s^2]
constexpr double kPeriod = 0.02;  // [s]
constexpr int kFilling = 2 * FreeRun::kDelay - 1;  // samples before the first prediction

FreeRun paperModel() {
  FreeRun run(kPeriod);
  run.setModel(kB1, kB0);
  return run;
}

// Of the paper's model at this period: (sqrt(b0) T)^4 / 24 = 1.3e-6 per unit of w''.
constexpr double kStepError = 1.5e-6;

// From wheel to body: G(s) = (b1 s + b0) / (s^2 + b1 s + b0).
std::complex<double> transferFunction(double b1, double b0, double omega) {
  const std::complex<double> s(0.0, omega);
  return (b1 * s + b0) / (s * s + b1 * s + b0);
}

// Relative error of the interpolation of w'' up to half of Nyquist's frequency and up to three quarters, see
// bandlimited_interpolator.h; its images at 2 pi / T - omega and beyond pass through the strut as well.
double interpolationTolerance(double b1, double b0, double omega, double period) {
  const double error = omega * period < 0.5 * kPi ? 2e-4 : 1e-3;
  return error * (std::abs(transferFunction(b1, b0, omega)) +
                  2.0 * std::abs(transferFunction(b1, b0, 2.0 * kPi / period - omega)));
}

void expectTransferFunction(double b1, double b0, double omega, double step_error) {
  SCOPED_TRACE("omega " + std::to_string(omega));
  FreeRun run(kPeriod);
  run.setModel(b1, b0);
  const std::complex<double> g = transferFunction(b1, b0, omega);
  const double tolerance = interpolationTolerance(b1, b0, omega, kPeriod) + step_error * std::abs(g);
  const auto settling = static_cast<int>(20.0 / (kPeriod * b1 / 2.0));  // e^-20 of the start is left
  for (int k = 0; k < settling + 200; ++k) {
    const std::optional<double> predicted = run.push(std::cos(omega * k * kPeriod));
    if (k < settling) continue;
    const std::complex<double> phasor = std::polar(1.0, omega * (k - FreeRun::kDelay) * kPeriod);
    ASSERT_NEAR(*predicted, (g * phasor).real(), tolerance) << "sample " << k;
    // d'' = w'' - z''
    const std::complex<double> travel = (1.0 - g) / -(omega * omega) * phasor;
    ASSERT_NEAR(run.travel(), travel.real(), tolerance * std::abs((1.0 - g) / (omega * omega * g)) + 1e-9);
    ASSERT_NEAR(run.unsprungAcceleration(), phasor.real(), 1e-12);
  }
}

TEST(FreeRun, AnswersASineByTheTransferFunctionAsLateAsItSays) {
  for (const double omega_t : {0.02, 0.1, 0.4, 1.5, 2.3}) expectTransferFunction(kB1, kB0, omega_t / kPeriod, 1e-6);
}

TEST(FreeRun, AnswersASineByTheTransferFunctionWhereASampleTakesSeveralSteps) {
  for (const double omega_t : {0.1, 0.4, 1.5}) expectTransferFunction(25.0, 4000.0, omega_t / kPeriod, 2e-4);
}

TEST(FreeRun, ConstantSuchAsGravityComesOutAgainFromTheFirstSampleOn) {
  FreeRun run = paperModel();
  for (int k = 0; k < kFilling; ++k) EXPECT_FALSE(run.push(9.81));
  for (int k = 0; k < 500; ++k) {
    ASSERT_NEAR(*run.push(9.81), 9.81, 9.81 * kStepError);
    ASSERT_NEAR(run.travel(), 9.81 / kB0, 9.81 / kB0 * kStepError);
  }
}

TEST(FreeRun, SettlesToTheStaticTravelAfterAStep) {
  FreeRun run = paperModel();
  for (int k = 0; k < 10; ++k) run.push(0.0);
  for (int k = 0; k < 1500; ++k) run.push(2.0);  // e^-45 of the step is left
  EXPECT_NEAR(run.travel(), 2.0 / kB0, kStepError);
  EXPECT_NEAR(run.travelRate(), 0.0, kStepError);
  EXPECT_NEAR(*run.push(2.0), 2.0, 2.0 * kStepError);
}

TEST(FreeRun, WheelThatIsPushedUpCompressesTheStrutAndLiftsTheBody) {
  FreeRun run = paperModel();
  for (int k = 0; k < 24; ++k) run.push(0.0);
  double predicted = 0.0;
  for (int k = 0; k < FreeRun::kDelay + 5; ++k) predicted = *run.push(1.0);
  EXPECT_GT(run.travel(), 0.0);
  EXPECT_GT(run.travelRate(), 0.0);
  EXPECT_GT(predicted, 0.0);
}

TEST(FreeRun, DecaysFreelyAsTheDampedOscillator) {
  FreeRun run = paperModel();
  for (int k = 0; k < 40; ++k) run.push(1.0 + k);
  for (int k = 0; k < 24; ++k) run.push(0.0);  // from here on the interpolated input is 0, too
  const double d0 = run.travel(), v0 = run.travelRate();
  const double sigma = kB1 / 2.0, omega = std::sqrt(kB0 - sigma * sigma);
  for (int k = 1; k <= 100; ++k) {
    run.push(0.0);
    const double t = k * kPeriod;
    const double expected =
        std::exp(-sigma * t) * (d0 * std::cos(omega * t) + (v0 + sigma * d0) / omega * std::sin(omega * t));
    ASSERT_NEAR(run.travel(), expected, 1e-5 * (std::abs(d0) + std::abs(v0) / omega));
  }
}

TEST(FreeRun, GivesNothingWithoutAModelOrWithFewerSamplesThanTheInterpolationTakes) {
  FreeRun run(kPeriod);
  for (int k = 0; k < 50; ++k) EXPECT_FALSE(run.push(1.0));
  EXPECT_FALSE(run.hasModel());
  run.setModel(kB1, kB0);
  EXPECT_TRUE(run.hasModel());
  EXPECT_TRUE(run.push(1.0));
}

TEST(FreeRun, RefusesModelsThatAreUnstableOrTooFastForTheSampling) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kTooFast = 33 * 0.35 / kPeriod;  // [1/s]
  const std::pair<double, double> refused[] = {
      {-1.0, kB0}, {0.0, kB0}, {kNan, kB0}, {kInfinity, kB0}, {kTooFast, kB0},
      {kB1, -1.0}, {kB1, 0.0}, {kB1, kNan}, {kB1, kInfinity}, {kB1, kTooFast * kTooFast}};
  FreeRun run = paperModel(), untouched = paperModel();
  for (const auto& [b1, b0] : refused) {
    EXPECT_FALSE(run.accepts(b1, b0)) << b1 << ", " << b0;
    EXPECT_FALSE(run.trySetModel(b1, b0)) << b1 << ", " << b0;
    EXPECT_THROW(run.setModel(b1, b0), std::invalid_argument) << b1 << ", " << b0;
  }
  EXPECT_TRUE(run.accepts(kTooFast * 0.9, kB0));
  for (int k = 0; k < 40; ++k) EXPECT_EQ(run.push(k), untouched.push(k));
  EXPECT_THROW(FreeRun(0.0), std::invalid_argument);
  EXPECT_THROW(FreeRun{kNan}, std::invalid_argument);
}

TEST(FreeRun, StaysFiniteAtTheFastestModelThatItAccepts) {
  FreeRun run(kPeriod);
  run.setModel(30 * 0.35 / kPeriod, std::pow(30 * 0.35 / kPeriod, 2));
  for (int k = 0; k < 1000; ++k) run.push(k % 2 == 0 ? 1.0 : -1.0);
  for (int k = 0; k < 40; ++k) run.push(1.0);
  EXPECT_NEAR(*run.push(1.0), 1.0, 1e-3);
}

TEST(FreeRun, ChangeOfStiffnessUnderGravityLeavesThePredictionAtRest) {
  FreeRun run = paperModel();
  for (int k = 0; k < 30; ++k) run.push(9.81);
  run.setModel(kB1, 1.1 * kB0);
  EXPECT_NEAR(*run.push(9.81), 9.81, 9.81 * kStepError);
  EXPECT_NEAR(run.travel(), 9.81 / (1.1 * kB0), 9.81 / kB0 * kStepError);
}

TEST(FreeRun, ResetStartsAnewWithTheSameModel) {
  FreeRun run = paperModel(), fresh = paperModel();
  for (int k = 0; k < 1000; ++k) run.push(std::sin(0.1 * k));
  ASSERT_TRUE(run.settled());
  run.reset();
  EXPECT_FALSE(run.settled());
  EXPECT_EQ(run.travel(), 0.0);
  // The mean of w'' is known already, so it starts from elsewhere.
  for (int k = 0; k < kFilling; ++k) {
    EXPECT_FALSE(run.push(std::cos(0.2 * k)));
    fresh.push(std::cos(0.2 * k));
  }
  std::optional<double> predicted, expected;
  for (int k = 0; k < 1000; ++k) {
    predicted = run.push(std::cos(0.2 * k));
    expected = fresh.push(std::cos(0.2 * k));
  }
  EXPECT_NEAR(*predicted, *expected, 1e-9);  // e^-30 of the start is left
}

// A run that starts in the middle of the drive knows as much as one from its beginning as soon as it says so.
void expectSettledMeansDecayed(double b1, double b0) {
  FreeRun whole(kPeriod), late(kPeriod);
  whole.setModel(b1, b0);
  late.setModel(b1, b0);
  double first_difference = 0.0;
  for (int k = 0; !late.settled(); ++k) {
    ASSERT_LT(k, 100000);
    const double input = std::sin(0.13 * k) + std::cos(0.05 * k);
    whole.push(input);
    if (k < 500 || !late.push(input)) continue;
    if (first_difference == 0.0)
      first_difference =
          std::hypot(whole.travel() - late.travel(), (whole.travelRate() - late.travelRate()) / std::sqrt(b0));
  }
  EXPECT_GT(first_difference, 0.0);
  // Two directions of the state decay together; their interplay adds a factor.
  EXPECT_LT(std::abs(whole.travel() - late.travel()), 3e-3 * first_difference);
  EXPECT_GT(first_difference, 1e-4);
}

TEST(FreeRun, IsSettledWhenTheUnknownStartHasDecayed) {
  expectSettledMeansDecayed(kB1, kB0);   // underdamped
  expectSettledMeansDecayed(20.0, kB0);  // overdamped: the slow root 0.72 1/s counts, not b1 / 2
}

TEST(FreeRun, SettlesAfterTheTimeOfTheSlowestRoot) {
  const auto samplesToSettle = [](double b1, double b0) {
    FreeRun run(kPeriod);
    run.setModel(b1, b0);
    int count = 0;
    while (!run.settled()) run.push(1.0), ++count;
    return count * kPeriod;
  };
  EXPECT_NEAR(samplesToSettle(kB1, kB0), std::log(1000.0) / 1.5 + kFilling * kPeriod, 3 * kPeriod);
  const double slow_root = 10.0 - std::sqrt(100.0 - kB0);
  EXPECT_NEAR(samplesToSettle(20.0, kB0), std::log(1000.0) / slow_root + kFilling * kPeriod, 3 * kPeriod);
}

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
      integrateStrut(model_, time_, kStep, {kStep * velocity / 8, velocity / 2, kStep * velocity / 2, velocity}, state_);
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
  FineStrut truth({kB1, kB0, effects, {}});
  FreeRun run(kPeriod);
  run.setModel(kB1, kB0);
  run.setEffects(effects);
  for (int k = 0; k < 4000; ++k) {
    const double t = k * kPeriod;
    const std::optional<double> predicted = run.push(wheel(t) + 9.81, t);
    if (!predicted) continue;
    const double expected = truth.forceAt((k - FreeRun::kDelay) * kPeriod, wheel);
    if (k < 3000) continue;
    // The mean of w'' is known to about max w' / 60 s = 0.008 m/s^2: 0.6 mm of travel that the effects see.
    ASSERT_NEAR(*predicted, 9.81 + expected, 0.03) << "sample " << k;
    ASSERT_NEAR(run.travel(), truth.state().travel, 2e-3);
    for (std::size_t j = 0; j < effects.size(); ++j) {
      const double force = effects[j].effect.force({run.travel(), run.travelRate(), t - FreeRun::kDelay * kPeriod,
                                                    truth.state().memory[j]},
                                                   effects[j].shapes.data());
      ASSERT_NEAR(run.effectForces()[j], force, 0.05 + 1e-9) << effects[j].effect.name;
    }
  }
}

TEST(FreeRun, LinearPartDoesNotFeelThatTheMeanIsStillUnsure) {
  FreeRun plain = paperModel(), centred = paperModel();
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
  FreeRun run = paperModel(), untouched = paperModel();
  std::optional<double> predicted, expected;
  for (int k = 0; k < 1500; ++k) {
    if (k == 500) run.setEffects({active("quadratic_damping", 0.0)});
    if (k == 1000) run.setEffects({});
    predicted = run.push(9.81 + std::sin(0.1 * k));
    expected = untouched.push(9.81 + std::sin(0.1 * k));
    if (expected) {
      ASSERT_NEAR(*predicted, *expected, 10.0 * kStepError) << k;
    }
  }
  EXPECT_NEAR(run.travel(), untouched.travel(), kStepError);
  EXPECT_TRUE(run.settled());
}

TEST(FreeRun, ThatRunsAwayStartsAnewAndCounts) {
  FreeRun run = paperModel();
  run.setEffects({active("asymmetric_spring", 0.0), active("quadratic_damping", -50.0)});  // feeds the motion
  double largest = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const std::optional<double> predicted = run.push(std::sin(0.1 * k) + 9.81);
    if (predicted) largest = std::max(largest, std::abs(*predicted));
  }
  EXPECT_GT(run.runaways(), 1u);
  EXPECT_LE(largest, 1e3 * 10.81);
  EXPECT_FALSE(run.settled() && run.runaways() == 0);
  run.setCoefficient(1, 5.0);
  const std::uint64_t before = run.runaways();
  for (int k = 0; k < 1000; ++k) run.push(std::sin(0.1 * k) + 9.81);
  EXPECT_EQ(run.runaways(), before);
  EXPECT_TRUE(run.settled());
}

TEST(FreeRun, RefusesEffectsThatItCannotHold) {
  FreeRun run = paperModel();
  EXPECT_THROW(run.setEffects(std::vector<ActiveEffect>(StrutState::kMostEffects + 1, active("asymmetric_spring", 1.0))),
               std::invalid_argument);
  EXPECT_THROW(run.setEffects({active("bump_stop", 1.0)}), std::invalid_argument);
  EXPECT_THROW(run.setEffects({active("bump_stop", std::nan(""), {0.1})}), std::invalid_argument);
  EXPECT_TRUE(run.model().effects.empty());
}

}  // namespace
}  // namespace suspension_health_monitor
