#include "suspension_health_monitor/internal/simulation/road.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "braked_road.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {
namespace {

// Central differences of step h; their error is of order h^2 times the third derivative, bounded by `tolerance`.
void expectDerivativesAgree(const Road& road, double t, double h, double tolerance) {
  const RoadPoint before = road(t - h), here = road(t), after = road(t + h);
  EXPECT_NEAR((after.height - before.height) / (2.0 * h), here.rate, tolerance) << "at " << t << " s";
  EXPECT_NEAR((after.rate - before.rate) / (2.0 * h), here.acceleration, tolerance) << "at " << t << " s";
}

TEST(PaperRoad, StartsFlatAndPushesUp) {
  const RoadPoint start = paperRoad(0.0);
  EXPECT_DOUBLE_EQ(start.height, 0.0);
  EXPECT_DOUBLE_EQ(start.rate, 0.0);
  // sum G (2 pi / T)^2, worked out apart.
  EXPECT_NEAR(start.acceleration, 0.843234001688118, 1e-12);
}

TEST(PaperRoad, TakesItsNumbersForPeriodsAndCentimetres) {
  EXPECT_NEAR(paperRoad(0.95).height, 0.164355708685809, 1e-14);
}

TEST(PaperRoad, DerivativesBelongToTheHeight) {
  // Third and fourth derivatives stay below 5 m/s^3 and 20 m/s^4.
  for (double t = 0.3; t < 20.0; t += 0.77) expectDerivativesAgree(paperRoad, t, 1e-4, 1e-7);
}

TEST(PaperBumps, AreFifteenCentimetresHighAtTheirTimes) {
  for (const double centre : {85.0, 110.0}) {
    const RoadPoint top = paperBumps(centre);
    EXPECT_NEAR(top.height, 0.15, 1e-12);
    EXPECT_NEAR(top.rate, 0.0, 1e-12);
    EXPECT_NEAR(top.acceleration, -2.0 * 22.2 * 0.15, 1e-12);
    const double half_width = std::sqrt(std::log(2.0) / 22.2);
    EXPECT_NEAR(paperBumps(centre - half_width).height, 0.075, 1e-12);
    EXPECT_NEAR(paperBumps(centre + half_width).height, 0.075, 1e-12);
  }
  EXPECT_LT(paperBumps(97.5).height, 1e-100);
}

TEST(PaperBumps, DerivativesBelongToTheHeight) {
  for (double t = 84.2; t < 85.9; t += 0.13) expectDerivativesAgree(paperBumps, t, 1e-5, 1e-6);
}

TEST(IsoRoad, ClassesAreAFactorFourApartAndFallWithSlopeMinusTwo) {
  EXPECT_DOUBLE_EQ(isoDisplacementDensity('A', 0.1), 16e-6);
  EXPECT_DOUBLE_EQ(isoDisplacementDensity('C', 0.1), 256e-6);
  EXPECT_DOUBLE_EQ(isoDisplacementDensity('H', 0.1), 262144e-6);
  EXPECT_NEAR(isoDisplacementDensity('C', 1.0), 2.56e-6, 1e-18);
  EXPECT_THROW(isoDisplacementDensity('I', 0.1), std::invalid_argument);
  EXPECT_THROW(IsoRoad('C', 0.0, 1), std::invalid_argument);
}

// One-sided periodogram, Hann window, of height against distance; index k stands for k / (length) cycles/m.
std::vector<double> heightSpectrum(Road road, double speed, double spacing, std::size_t count) {
  std::vector<double> heights(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i);
    const double window = 0.5 - 0.5 * std::cos(2.0 * M_PI * x / static_cast<double>(count));
    heights[i] = window * road(x * spacing / speed).height;
  }
  std::vector<std::complex<double>> transform;
  Eigen::FFT<double>().fwd(transform, heights);
  std::vector<double> density(count / 2);
  // The mean square of the Hann window is 3/8.
  const double scale = 2.0 * spacing / (static_cast<double>(count) * 0.375);
  for (std::size_t k = 0; k < density.size(); ++k) density[k] = scale * std::norm(transform[k]);
  return density;
}

TEST(IsoRoad, HasTheVarianceOfItsClassInEveryOctave) {
  const double speed = 7.0, spacing = 0.15;
  const std::size_t count = 1 << 17;
  const double resolution = 1.0 / (spacing * static_cast<double>(count));
  const std::vector<double> density = heightSpectrum(IsoRoad('C', speed, 3), speed, spacing, count);
  for (double low = 0.02; low < 2.0; low *= 2.0) {
    double variance = 0.0;
    for (auto k = static_cast<std::size_t>(std::lround(low / resolution));
         static_cast<double>(k) * resolution < 2.0 * low; ++k) {
      variance += density[k] * resolution;
    }
    const double expected = 256e-6 * 0.01 * (1.0 / low - 1.0 / (2.0 * low));
    // 64 sinusoids an octave: up to one too many or too few at either end is 2.2 % + 1.1 %; the rest is for pairs
    // closer than the spectrum resolves. Another class is 300 % off, a slope of -2.1 is 7 % an octave.
    EXPECT_NEAR(variance / expected, 1.0, 0.05) << "octave from " << low << " cycles/m";
  }
}

/// The sum of the waves of an IsoRoad with seed 1 at 15 m/s, without a grid.
RoadPoint sumOfWaves(char road_class, double lateral, double t) {
  constexpr double kSpeed = 15.0;
  RandomStream random(1, RandomPurpose::kRoad), across(1, RandomPurpose::kRoadLateral);
  const double ratio = std::pow(IsoRoad::kHighest / IsoRoad::kLowest, 1.0 / IsoRoad::kComponents);
  RoadPoint sum;
  for (int i = 0; i < IsoRoad::kComponents; ++i) {
    const double low = IsoRoad::kLowest * std::pow(ratio, i), n = low * std::pow(ratio, random.uniform());
    const double variance = isoDisplacementDensity(road_class, low) * low * (1.0 - 1.0 / ratio);
    const double s = 2.0 * across.uniform() - 1.0, m = n * s / std::sqrt(1.0 - s * s);
    const double omega = 2.0 * M_PI * n * kSpeed;
    const double angle = omega * t + 2.0 * M_PI * (random.uniform() + m * lateral);
    const double cosine = std::sqrt(2.0 * variance) * std::cos(angle);
    const double sine = std::sqrt(2.0 * variance) * std::sin(angle);
    sum = sum + RoadPoint{cosine, -omega * sine, -omega * omega * cosine};
  }
  return sum;
}

TEST(IsoRoad, InterpolatesAsExactlyAsStated) {
  IsoRoad road('D', 15.0, 1);
  double error = 0.0, square = 0.0, rate_error = 0.0;
  int count = 0;
  for (double t = 0.0; t < 30.0; t += 0.01317, ++count) {
    const RoadPoint interpolated = road(t), exact = sumOfWaves('D', 0.0, t);
    error += std::pow(interpolated.acceleration - exact.acceleration, 2);
    square += std::pow(exact.acceleration, 2);
    rate_error = std::max(rate_error, std::abs(interpolated.rate - exact.rate));
    EXPECT_NEAR(interpolated.height, exact.height, 1e-9);
  }
  // 5.1e-6 (n / n_max)^4 of each sinusoid's acceleration, whose mean square grows as n^2 dn: sqrt(3/11) of 5.1e-6 in
  // all.
  EXPECT_LT(std::sqrt(error / square), 5.1e-6 * std::sqrt(3.0 / 11.0));
  EXPECT_LT(rate_error, 1e-6);
}

TEST(IsoRoad, DerivativesBelongToTheHeight) {
  // The fastest sinusoid turns at 2 pi 2.83 10 = 178 rad/s, accelerations reach 100 m/s^2: (178 h)^2 / 6 * 100 for h =
  // 1e-5.
  for (double t = 0.5; t < 20.0; t += 0.77) expectDerivativesAgree(IsoRoad('C', 10.0, 5), t, 1e-5, 1e-4);
}

TEST(IsoRoad, IsTheSameProfileOverDistanceAtAnySpeedAndScalesWithTheClass) {
  IsoRoad slow('B', 5.0, 9), fast('B', 10.0, 9), rough('C', 5.0, 9), other('B', 5.0, 10);
  for (double t = 0.0; t < 10.0; t += 0.37) {
    EXPECT_NEAR(fast(t).height, slow(2.0 * t).height, 1e-12);
    EXPECT_NEAR(fast(t).rate, 2.0 * slow(2.0 * t).rate, 1e-9);
    EXPECT_NEAR(rough(t).height, 2.0 * slow(t).height, 1e-12);
    EXPECT_NE(other(t).height, slow(t).height);
  }
}

TEST(IsoRoad, DoesNotDependOnTheOrderOfTheQuestions) {
  IsoRoad forward('E', 2.0, 1), backward('E', 2.0, 1);
  std::vector<double> heights;
  for (int i = 0; i < 200; ++i) heights.push_back(forward(0.71 * i).height);
  for (int i = 199; i >= 0; --i) EXPECT_EQ(backward(0.71 * i).height, heights[static_cast<std::size_t>(i)]);
}

// Before, during and after the brake.
TEST(BrakedPaperRoad, ComesToAStandWithTheDerivativesOfItsHeight) {
  constexpr double kStop = 57.0, kBrake = 3.0, kMiddle = kStop + 0.5 * kBrake;
  const Road road = brakedPaperRoad(kStop, kBrake);
  for (const double t : {20.0, 57.5, kMiddle, 59.7, 61.0}) expectDerivativesAgree(road, t, 1e-4, 1e-6);
  EXPECT_EQ(road(20.0).height, paperRoad(20.0).height);
  EXPECT_NEAR(road(kMiddle).height, paperRoad(kStop + (0.25 + 0.5 / M_PI) * kBrake).height, 1e-12);
  EXPECT_NEAR(road(kMiddle).rate, 0.5 * paperRoad(kStop + (0.25 + 0.5 / M_PI) * kBrake).rate, 1e-12);
  EXPECT_EQ(road(61.0).height, paperRoad(kStop + 0.5 * kBrake).height);
  EXPECT_NEAR(road(61.0).rate, 0.0, 1e-12);
}

TEST(IsoRoad, DoesNotRepeat) {
  IsoRoad road('C', 1.0, 2);
  constexpr int kPiece = 500;  // 50 m
  Eigen::VectorXd acceleration(30000);
  for (Eigen::Index i = 0; i < acceleration.size(); ++i)
    acceleration[i] = road(0.1 * static_cast<double>(i)).acceleration;
  const Eigen::VectorXd first = acceleration.head(kPiece).normalized();
  double closest = 0.0;
  for (Eigen::Index lag = kPiece; lag + kPiece <= acceleration.size(); ++lag) {
    const Eigen::VectorXd later = acceleration.segment(lag, kPiece);
    closest = std::max(closest, first.dot(later) / later.norm());
  }
  // Two unrelated pieces of length X correlate with variance integral S^2 dn / (integral S dn)^2 / (2 X); the density S
  // of the acceleration grows as n^2 up to 2.83 cycles/m, which gives 9/5 / (2 50 2.83) = 0.08^2. A repeat gives 1.
  EXPECT_LT(closest, 5.5 * 0.08);
}

TEST(IsoRoad, IsTheSumOfItsWavesBeforeTheStartOfTheDriveToo) {
  IsoRoad road('C', 15.0, 1, 0.7);
  for (double t = -1.0; t < 1.0; t += 0.0137) ASSERT_NEAR(road(t).height, sumOfWaves('C', 0.7, t).height, 1e-8) << t;
}

}  // namespace
}  // namespace suspension_health_monitor
