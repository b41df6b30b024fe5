#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "paper_drive.h"
#include "reference/batch_estimators.h"

namespace suspension_health_monitor {
namespace {

using Taps = std::vector<long double>;  // taps[i] belongs to q^-i

Taps multiply(const Taps& a, const Taps& b) {
  Taps product(a.size() + b.size() - 1, 0.0L);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  return product;
}

// The FIR (9), factor by factor as it is printed.
Taps equation9(int n, int r, int horizon, double period) {
  Taps taps{1.0L};
  for (int i = 0; i < n - r; ++i) taps = multiply(taps, {period / 2.0L, period / 2.0L});
  for (int i = 0; i < r; ++i) taps = multiply(taps, {1.0L, -1.0L});
  for (int i = 0; i < n; ++i) taps = multiply(taps, Taps(static_cast<std::size_t>(horizon), 1.0L));
  return taps;
}

// Weights of one integral over the horizon [units of T].
Taps integralTaps(IntegrationRule rule, int horizon) {
  Taps taps;
  if (rule == IntegrationRule::kTrapezoid) {
    taps.assign(static_cast<std::size_t>(horizon) + 1, 1.0L);
    taps.front() = taps.back() = 0.5L;
  } else {  // what one impulse makes of it; its own laws are tested below
    HorizonIntegral integral(horizon, 1.0, rule);
    DelayLine impulse(integral.requiredHistory());
    for (int i = 0; i < integral.requiredHistory(); ++i) {
      impulse.push(i == 0 ? 1.0 : 0.0);
      taps.push_back(integral.update(impulse));
    }
  }
  return taps;
}

Taps filterTaps(IntegrationRule rule, int n, int r, int horizon, double period) {
  Taps integral = integralTaps(rule, horizon);
  for (long double& tap : integral) tap *= period;
  const auto late = static_cast<std::size_t>(HorizonIntegral::lateness(rule));
  Taps difference(late + static_cast<std::size_t>(horizon) + 1, 0.0L);
  difference[late] = 1.0L;
  difference.back() = -1.0L;
  Taps taps{1.0L};
  for (int i = 0; i < n - r; ++i) taps = multiply(taps, integral);
  for (int i = 0; i < r; ++i) taps = multiply(taps, difference);
  return taps;
}

// Quick white noise in [-1, 1), equal on every machine.
class Noise {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(static_cast<std::int64_t>(state_)) * 0x1p-63;
  }

 private:
  std::uint64_t state_ = 12345;
};

double rmsOfFilteredNoise(const Taps& taps) {
  long double sum = 0.0L;
  for (const long double tap : taps) sum += tap * tap;
  return static_cast<double>(std::sqrt(sum / 3.0L));
}

// Sum of taps times the newest samples of a ring that holds sample k at k % size.
double convolve(const Taps& taps, const std::vector<double>& ring, std::size_t newest) {
  long double sum = 0.0L;
  for (std::size_t i = 0; i < taps.size(); ++i) sum += taps[i] * ring[(newest + ring.size() - i) % ring.size()];
  return static_cast<double>(sum);
}

constexpr IntegrationRule kRules[] = {IntegrationRule::kTrapezoid, IntegrationRule::kBandLimited};

TEST(LinearIntegralFilter, IsTheFirOfEquation9WithTheTrapezoidRule) {
  for (const int horizon : {1, 2, 5, 30})
    for (int n = 1; n <= 4; ++n)
      for (int r = 0; r <= n; ++r) {
        const Taps expected = equation9(n, r, horizon, 0.02);
        const Taps actual = filterTaps(IntegrationRule::kTrapezoid, n, r, horizon, 0.02);
        ASSERT_EQ(actual.size(), expected.size());
        for (std::size_t i = 0; i < actual.size(); ++i)
          EXPECT_NEAR(static_cast<double>(actual[i] - expected[i]), 0.0, 1e-15 * rmsOfFilteredNoise(expected));
      }
}

TEST(LinearIntegralFilter, EqualsDirectConvolutionForEveryOrderDerivativeHorizonAndRule) {
  const double period = 0.02;
  for (const IntegrationRule rule : kRules)
    for (const int horizon : {1, 6, 12, 30})
      for (int n = 1; n <= 4; ++n) {
        LinearIntegralFilter filter(n, {horizon, period, rule});
        std::vector<double> signal;
        Noise noise;
        for (int k = 0; k < 2 * LinearIntegralFilter::window(n, {horizon, period, rule}); ++k) {
          signal.push_back(noise());
          filter.push(signal.back());
        }
        for (int r = 0; r <= n; ++r) {
          const Taps taps = filterTaps(rule, n, r, horizon, period);
          EXPECT_NEAR(filter.output(r), convolve(taps, signal, signal.size() - 1), 1e-12 * rmsOfFilteredNoise(taps))
              << "n = " << n << ", r = " << r << ", L = " << horizon;
        }
      }
}

TEST(LinearIntegralFilter, SavesTheIntegralsBelowTheLowestDerivativeWithoutChangingTheOthers) {
  LinearIntegralFilter all(3, {8, 0.1, IntegrationRule::kBandLimited});
  LinearIntegralFilter some(3, {8, 0.1, IntegrationRule::kBandLimited}, 2);
  Noise noise;
  for (int k = 0; k < 100; ++k) {
    const double sample = noise();
    all.push(sample);
    some.push(sample);
  }
  for (const int r : {2, 3}) EXPECT_EQ(all.output(r), some.output(r));
}

TEST(LinearIntegralFilter, IsFullAfterOrderTimesHorizonPlusOneSamplesAndEmptyAfterReset) {
  for (const IntegrationRule rule : kRules) {
    const int of_corrections = rule == IntegrationRule::kTrapezoid ? 0 : 12;
    LinearIntegralFilter filter(3, {7, 0.1, rule});
    for (const int round : {0, 1}) {
      for (int k = 0; k < 3 * (7 + of_corrections); ++k) {
        filter.push(round == 0 ? 1e6 : 1.0);
        EXPECT_FALSE(filter.full());
      }
      filter.push(round == 0 ? 1e6 : 1.0);
      EXPECT_TRUE(filter.full());
      if (round == 0) filter.reset();
    }
    EXPECT_NEAR(filter.output(0), 0.7 * 0.7 * 0.7, 1e-15);
  }
}

TEST(LinearIntegralFilter, IntegratesPolynomialsExactlyUpToTheDegreeOfTheRule) {
  const int horizon = 8;
  const double period = 0.25, end = 3.0;
  const double start = end - horizon * period;
  const auto degreeOf = [](IntegrationRule rule) { return rule == IntegrationRule::kTrapezoid ? 1 : 3; };
  for (const IntegrationRule rule : kRules)
    for (int degree = 0; degree <= 4; ++degree) {
      LinearIntegralFilter filter(1, {horizon, period, rule});
      const int late = HorizonIntegral::lateness(rule);
      for (int k = -late; k <= horizon + late; ++k) filter.push(std::pow(start + k * period, degree));
      const double exact = (std::pow(end, degree + 1) - std::pow(start, degree + 1)) / (degree + 1);
      const double error = std::abs(filter.output(0) / exact - 1.0);
      const bool exact_here = degree <= degreeOf(rule);
      EXPECT_EQ(error < 1e-14, exact_here) << "degree " << degree << ", error " << error;
    }
}

// Error of the double integral of sin(3 t) over h = 0.6 s against -(1/9) [sin(3 t) - 2 sin(3 (t - h)) + sin(3 (t - 2
// h))].
double errorOnSine(IntegrationRule rule, int horizon) {
  const double period = 0.6 / horizon, omega = 3.0, phase = 0.4;
  LinearIntegralFilter filter(2, {horizon, period, rule});
  const int late = 2 * HorizonIntegral::lateness(rule);
  for (int k = -late; k <= 2 * horizon + late; ++k) filter.push(std::sin(omega * k * period + phase));
  const auto sine = [&](double t) { return std::sin(omega * t + phase); };
  const double exact = -(sine(1.2) - 2.0 * sine(0.6) + sine(0.0)) / (omega * omega);
  return std::abs(filter.output(0) / exact - 1.0);
}

TEST(LinearIntegralFilter, ConvergesToTheIntegralOfASineWithTheOrderOfTheRule) {
  EXPECT_NEAR(errorOnSine(IntegrationRule::kTrapezoid, 15) / errorOnSine(IntegrationRule::kTrapezoid, 30), 4.0, 0.1);
  EXPECT_NEAR(errorOnSine(IntegrationRule::kBandLimited, 20) / errorOnSine(IntegrationRule::kBandLimited, 40), 16.0,
              1.0);
  EXPECT_LT(errorOnSine(IntegrationRule::kBandLimited, 40), 1e-6);
}

// The integral of exp(i w t) over 20 samples, within a share of the longest that there is, 2 / w. Of a wheel that hops
// at a quarter of the rate (w = pi / 2) the trapezoid rule misses 0.21 of it.
TEST(HorizonIntegral, OfWhatOscillatesIsRightUpToSevenTenthsOfTheNyquistFrequency) {
  constexpr int kIntervals = 20;
  const int late = HorizonIntegral::lateness(IntegrationRule::kBandLimited);
  for (const double omega : {0.1, 0.3, 0.5, 0.8, 1.0, 1.3, 0.5 * M_PI, 0.6 * M_PI, 0.7 * M_PI})
    for (const double phase : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
      HorizonIntegral integral(kIntervals, 1.0, IntegrationRule::kBandLimited);
      DelayLine signal(integral.requiredHistory());
      double found = 0.0;
      for (int k = -late; k <= kIntervals + late; ++k) {
        signal.push(std::sin(omega * k + phase));
        found = integral.update(signal);
      }
      const double exact = (std::cos(phase) - std::cos(omega * kIntervals + phase)) / omega;
      EXPECT_NEAR(found, exact, (omega < 1.6 ? 0.0005 : 0.004) * 2.0 / omega) << omega << " " << phase;
    }
}

Eigen::VectorXd noiseFreeBias(IntegrationRule rule) {
  static const std::vector<CornerSample> drive = healthyPaperDrive(120.0, 0.0);
  const auto theta = batchLeastSquares(stack(strutRows(drive, {30, 0.02, rule})));
  return theta.value().cwiseQuotient(Eigen::Vector2d(kPaperB1, kPaperB0)) - Eigen::Vector2d::Ones();
}

// One trapezoid integral of a sine is short by x = (omega T)^2 / 12, so that b1 comes out x and b0 2 x too large if
// there is one frequency. The paper's four (x = 1.7e-4 to 7.8e-4) give +0.058 % and +0.093 %; an independent NumPy
// computation of Eq. (9) and (31) gives the same.
TEST(LinearIntegralFilter, BandLimitedRuleTakesTheBiasOfTheTrapezoidRuleAtLeastTenfold) {
  const Eigen::VectorXd trapezoid = noiseFreeBias(IntegrationRule::kTrapezoid);
  EXPECT_NEAR(trapezoid[kDampingToMass], 0.00058, 0.00003);
  EXPECT_NEAR(trapezoid[kStiffnessToMass], 0.00093, 0.00003);
  const Eigen::VectorXd better = noiseFreeBias(IntegrationRule::kBandLimited);
  for (const int i : {0, 1}) EXPECT_LT(std::abs(better[i]), 0.1 * trapezoid[i]) << "parameter " << i;
}

// Largest deviation of I_r^2 from the FIR over the last samples, relative to the rms of the output, with a huge outlier
// half-way.
double driftAfter(std::size_t num_samples, int horizon) {
  const IntegralFilterOptions options{horizon, 0.02, IntegrationRule::kBandLimited};
  LinearIntegralFilter filter(2, options);
  const auto memory = static_cast<std::size_t>(LinearIntegralFilter::window(2, options));
  std::vector<double> ring(memory);
  const Taps taps[] = {filterTaps(IntegrationRule::kBandLimited, 2, 0, horizon, 0.02),
                       filterTaps(IntegrationRule::kBandLimited, 2, 1, horizon, 0.02)};
  Noise noise;
  double worst = 0.0;
  for (std::size_t k = 0, place = 0; k < num_samples; ++k) {
    const double sample = k == num_samples / 2 ? 1e12 : noise();
    filter.push(sample);
    if (k + 3 * memory < num_samples) continue;
    place = k % memory;
    ring[place] = sample;
    if (k + 2 * memory < num_samples || k % 7 != 0) continue;
    for (const int r : {0, 1})
      worst =
          std::max(worst, std::abs(filter.output(r) - convolve(taps[r], ring, place)) / rmsOfFilteredNoise(taps[r]));
  }
  return worst;
}

TEST(LinearIntegralFilter, NeitherDriftsOverAHundredMillionSamplesNorKeepsATraceOfAnOutlier) {
  EXPECT_LT(driftAfter(100'000'000, 30), 1e-9);
}

TEST(LinearIntegralFilter, KeepsNoTraceOfAnOutlierWithALongHorizonEither) {
  EXPECT_LT(driftAfter(2'000'000, 3000), 1e-9);
}

std::string refusal(const IntegralFilterOptions& options, int order = 2, int lowest_derivative = 0) {
  try {
    LinearIntegralFilter filter(order, options, lowest_derivative);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(LinearIntegralFilter, RefusesWrongOptionsByNameAndValue) {
  EXPECT_NE(refusal({0, 0.02, IntegrationRule::kTrapezoid}).find("horizon_samples = 0"), std::string::npos);
  EXPECT_NE(refusal({30, 0.0, IntegrationRule::kBandLimited}).find("sample_period = 0"), std::string::npos);
  EXPECT_NE(refusal({30, std::nan(""), IntegrationRule::kBandLimited}).find("sample_period"), std::string::npos);
  EXPECT_NE(refusal({}, 0).find("n = 0"), std::string::npos);
  EXPECT_NE(refusal({}, 2, 3).find("r = 3"), std::string::npos);
  EXPECT_EQ(refusal({1, 0.02, IntegrationRule::kBandLimited}), "");
}

}  // namespace
}  // namespace suspension_health_monitor
