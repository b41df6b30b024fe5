#include "suspension_health_monitor/internal/model/free_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "paper_free_run.h"

namespace suspension_health_monitor {
namespace {

constexpr int kFilling = 2 * FreeRun::kDelay - 1;  // samples before the first prediction

// From wheel to body: G(s) = (b1 s + b0) / (s^2 + b1 s + b0).
std::complex<double> transferFunction(double b1, double b0, double omega) {
  const std::complex<double> s(0.0, omega);
  return (b1 * s + b0) / (s * s + b1 * s + b0);
}

// Relative error of the interpolation of w'' up to half of Nyquist's frequency and up to three quarters, see
// bandlimited_interpolator.h; its images at 2 pi / T - omega and beyond pass through the strut as well.
double interpolationTolerance(double b1, double b0, double omega, double period) {
  const double error = omega * period < 0.5 * M_PI ? 2e-4 : 1e-3;
  return error * (std::abs(transferFunction(b1, b0, omega)) +
                  2.0 * std::abs(transferFunction(b1, b0, 2.0 * M_PI / period - omega)));
}

void expectTransferFunction(double b1, double b0, double omega, double step_error) {
  SCOPED_TRACE("omega " + std::to_string(omega));
  FreeRun run(kPaperPeriod);
  EXPECT_TRUE(run.trySetModel(b1, b0));
  const std::complex<double> g = transferFunction(b1, b0, omega);
  const double tolerance = interpolationTolerance(b1, b0, omega, kPaperPeriod) + step_error * std::abs(g);
  const auto settling = static_cast<int>(20.0 / (kPaperPeriod * b1 / 2.0));  // e^-20 of the start is left
  for (int k = 0; k < settling + 200; ++k) {
    const std::optional<double> predicted = run.push(std::cos(omega * k * kPaperPeriod));
    if (k < settling) continue;
    const std::complex<double> phasor = std::polar(1.0, omega * (k - FreeRun::kDelay) * kPaperPeriod);
    ASSERT_NEAR(*predicted, (g * phasor).real(), tolerance) << "sample " << k;
    // d'' = w'' - z''
    const std::complex<double> travel = (1.0 - g) / -(omega * omega) * phasor;
    ASSERT_NEAR(run.travel(), travel.real(), tolerance * std::abs((1.0 - g) / (omega * omega * g)) + 1e-9);
  }
}

TEST(FreeRun, AnswersASineByTheTransferFunctionAsLateAsItSays) {
  for (const double omega_t : {0.02, 0.1, 0.4, 1.5, 2.3})
    expectTransferFunction(kPaperB1, kPaperB0, omega_t / kPaperPeriod, 1e-6);
}

TEST(FreeRun, AnswersASineByTheTransferFunctionWhereASampleTakesSeveralSteps) {
  for (const double omega_t : {0.1, 0.4, 1.5}) expectTransferFunction(25.0, 4000.0, omega_t / kPaperPeriod, 2e-4);
}

TEST(FreeRun, ConstantSuchAsGravityComesOutAgainFromTheFirstSampleOn) {
  FreeRun run = paperFreeRun();
  for (int k = 0; k < kFilling; ++k) EXPECT_FALSE(run.push(9.81));
  for (int k = 0; k < 500; ++k) {
    ASSERT_NEAR(*run.push(9.81), 9.81, 9.81 * kPaperStepError);
    ASSERT_NEAR(run.travel(), 9.81 / kPaperB0, 9.81 / kPaperB0 * kPaperStepError);
  }
}

TEST(FreeRun, SettlesToTheStaticTravelAfterAStep) {
  FreeRun run = paperFreeRun();
  for (int k = 0; k < 10; ++k) run.push(0.0);
  for (int k = 0; k < 1500; ++k) run.push(2.0);  // e^-45 of the step is left
  EXPECT_NEAR(run.travel(), 2.0 / kPaperB0, kPaperStepError);
  EXPECT_NEAR(run.travelRate(), 0.0, kPaperStepError);
  EXPECT_NEAR(*run.push(2.0), 2.0, 2.0 * kPaperStepError);
}

TEST(FreeRun, WheelThatIsPushedUpCompressesTheStrutAndLiftsTheBody) {
  FreeRun run = paperFreeRun();
  for (int k = 0; k < 24; ++k) run.push(0.0);
  double predicted = 0.0;
  for (int k = 0; k < FreeRun::kDelay + 5; ++k) predicted = *run.push(1.0);
  EXPECT_GT(run.travel(), 0.0);
  EXPECT_GT(run.travelRate(), 0.0);
  EXPECT_GT(predicted, 0.0);
}

TEST(FreeRun, DecaysFreelyAsTheDampedOscillator) {
  FreeRun run = paperFreeRun();
  for (int k = 0; k < 40; ++k) run.push(1.0 + k);
  for (int k = 0; k < 24; ++k) run.push(0.0);  // from here on the interpolated input is 0, too
  const double d0 = run.travel(), v0 = run.travelRate();
  const double sigma = kPaperB1 / 2.0, omega = std::sqrt(kPaperB0 - sigma * sigma);
  for (int k = 1; k <= 100; ++k) {
    run.push(0.0);
    const double t = k * kPaperPeriod;
    const double expected =
        std::exp(-sigma * t) * (d0 * std::cos(omega * t) + (v0 + sigma * d0) / omega * std::sin(omega * t));
    ASSERT_NEAR(run.travel(), expected, 1e-5 * (std::abs(d0) + std::abs(v0) / omega));
  }
}

TEST(FreeRun, GivesNothingWithoutAModelOrWithFewerSamplesThanTheInterpolationTakes) {
  FreeRun run(kPaperPeriod);
  for (int k = 0; k < 50; ++k) EXPECT_FALSE(run.push(1.0));
  EXPECT_FALSE(run.hasModel());
  EXPECT_TRUE(run.trySetModel(kPaperB1, kPaperB0));
  EXPECT_TRUE(run.hasModel());
  EXPECT_TRUE(run.push(1.0));
}

TEST(FreeRun, RefusesModelsThatAreUnstableOrTooFastForTheSampling) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kTooFast = 33 * 0.35 / kPaperPeriod;  // [1/s]
  const std::pair<double, double> refused[] = {
      {-1.0, kPaperB0}, {0.0, kPaperB0}, {kNan, kPaperB0}, {kInfinity, kPaperB0}, {kTooFast, kPaperB0},
      {kPaperB1, -1.0}, {kPaperB1, 0.0}, {kPaperB1, kNan}, {kPaperB1, kInfinity}, {kPaperB1, kTooFast * kTooFast}};
  FreeRun run = paperFreeRun(), untouched = paperFreeRun();
  for (const auto& [b1, b0] : refused) EXPECT_FALSE(run.trySetModel(b1, b0)) << b1 << ", " << b0;
  EXPECT_TRUE(paperFreeRun().trySetModel(kTooFast * 0.9, kPaperB0));
  for (int k = 0; k < 40; ++k) EXPECT_EQ(run.push(k), untouched.push(k));
  EXPECT_THROW(FreeRun(0.0), std::invalid_argument);
  EXPECT_THROW(FreeRun{kNan}, std::invalid_argument);
}

TEST(FreeRun, StaysFiniteAtTheFastestModelThatItAccepts) {
  FreeRun run(kPaperPeriod);
  EXPECT_TRUE(run.trySetModel(30 * 0.35 / kPaperPeriod, std::pow(30 * 0.35 / kPaperPeriod, 2)));
  for (int k = 0; k < 1000; ++k) run.push(k % 2 == 0 ? 1.0 : -1.0);
  for (int k = 0; k < 40; ++k) run.push(1.0);
  EXPECT_NEAR(*run.push(1.0), 1.0, 1e-3);
}

TEST(FreeRun, ChangeOfStiffnessUnderGravityLeavesThePredictionAtRest) {
  FreeRun run = paperFreeRun();
  for (int k = 0; k < 30; ++k) run.push(9.81);
  EXPECT_TRUE(run.trySetModel(kPaperB1, 1.1 * kPaperB0));
  EXPECT_NEAR(*run.push(9.81), 9.81, 9.81 * kPaperStepError);
  EXPECT_NEAR(run.travel(), 9.81 / (1.1 * kPaperB0), 9.81 / kPaperB0 * kPaperStepError);
}

TEST(FreeRun, ResetStartsAnewWithTheSameModel) {
  FreeRun run = paperFreeRun(), fresh = paperFreeRun();
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
  FreeRun whole(kPaperPeriod), late(kPaperPeriod);
  EXPECT_TRUE(whole.trySetModel(b1, b0));
  EXPECT_TRUE(late.trySetModel(b1, b0));
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
  expectSettledMeansDecayed(kPaperB1, kPaperB0);  // underdamped
  expectSettledMeansDecayed(20.0, kPaperB0);      // overdamped: the slow root 0.72 1/s counts, not b1 / 2
}

TEST(FreeRun, SettlesAfterTheTimeOfTheSlowestRoot) {
  const auto samplesToSettle = [](double b1, double b0) {
    FreeRun run(kPaperPeriod);
    EXPECT_TRUE(run.trySetModel(b1, b0));
    int count = 0;
    while (!run.settled()) run.push(1.0), ++count;
    return count * kPaperPeriod;
  };
  EXPECT_NEAR(samplesToSettle(kPaperB1, kPaperB0), std::log(1000.0) / 1.5 + kFilling * kPaperPeriod, 3 * kPaperPeriod);
  const double slow_root = 10.0 - std::sqrt(100.0 - kPaperB0);
  EXPECT_NEAR(samplesToSettle(20.0, kPaperB0), std::log(1000.0) / slow_root + kFilling * kPaperPeriod,
              3 * kPaperPeriod);
}

}  // namespace
}  // namespace suspension_health_monitor
