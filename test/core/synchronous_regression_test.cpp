// Rows of two IMUs whose clocks differ: the skew is found whatever the strut is, and the rows obey the strut.
#include "suspension_health_monitor/internal/identification/synchronous_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 6.0, kB0 = 63.0, kPeriod = 0.005, kForgetting = 0.9975;
constexpr IntegralFilterOptions kFilter{120, kPeriod, IntegrationRule::kBandLimited};
constexpr double kOmegas[]{5.0, 9.0, 21.0, 47.0, 66.0, 83.0};

// A body on a strut over a wheel that moves by six sines; z'' = H w'', H = (b1 s + b0) / (s^2 + b1 s + b0).
struct Sines {
  double b1 = kB1, b0 = kB0, late = 0.0, offset = 0.0, noise = 0.0, engine = 0.0;
  std::mt19937_64 random{1};
  std::normal_distribution<double> gauss{};

  CornerSample at(double t) {
    double body = engine * std::sin(200.0 * t), wheel = offset;
    for (const double omega : kOmegas) {
      const std::complex<double> s(0.0, omega), wave = std::exp(s * t);
      body += std::real((b1 * s + b0) / (s * s + b1 * s + b0) * wave);
      wheel += std::real(wave * std::exp(-s * late));
    }
    return {fromSeconds(t), body + noise * gauss(random), wheel + noise * gauss(random)};
  }
};

Sines lateWithNoise(double noise, unsigned seed) {
  Sines sines;
  sines.late = -0.0031;
  sines.noise = noise;
  sines.random.seed(seed);
  return sines;
}

SynchronousRegression regression() {
  return {kFilter, SensorColumns::kDriftingOffset, RegressorNoise(kFilter), kForgetting};
}

void drive(SynchronousRegression& rows, Sines& sines, double from, double to) {
  for (int k = static_cast<int>(from / kPeriod); k * kPeriod < to; ++k)
    if (const RegressionRow* row = rows.push(sines.at(k * kPeriod), nullptr)) rows.learnSkew(row->output);
}

TEST(SynchronousRegression, RowsOfALateWheelObeyTheStrut) {
  for (const double late : {0.0, 0.002, -0.0055, 0.0103, -0.014}) {
    SCOPED_TRACE(late);
    Sines sines;
    sines.late = late;
    sines.offset = 0.3;
    SynchronousRegression rows = regression();
    drive(rows, sines, 0.0, 8.0);
    ASSERT_NE(rows.skew(), nullptr);
    EXPECT_TRUE(rows.skew()->isWithin());
    EXPECT_NEAR(rows.skew()->skew(), late, 5e-5);
    for (int k = 0; k < 200; ++k) {
      const RegressionRow* row = rows.push(sines.at(8.0 + k * kPeriod), nullptr);
      ASSERT_NE(row, nullptr);
      const Eigen::Vector4d theta(kB1, kB0, -kB0 * sines.offset, 0.0);
      EXPECT_NEAR(row->output, row->regressor.dot(theta), 0.02 * kB1);  // of an output of up to 20
    }
  }
}

TEST(SynchronousRegression, TheSkewIsKnownWithinItsStandardDeviation) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    Sines sines = lateWithNoise(0.1, seed);
    SynchronousRegression rows = regression();
    drive(rows, sines, 0.0, 3.0);
    const double early = std::sqrt(rows.skew()->variance());
    EXPECT_NEAR(rows.skew()->skew(), sines.late, 3.0 * early);
    drive(rows, sines, 3.0, 40.0);
    const double stddev = std::sqrt(rows.skew()->variance());
    EXPECT_NEAR(rows.skew()->skew(), sines.late, 3.0 * stddev);
    EXPECT_LT(stddev, 0.8 * early);
    EXPECT_LT(stddev, 3e-3);
  }
}

// So much noise is in the regressors, too, and moves the skew of the best strut for good.
TEST(SynchronousRegression, WhatNoiseMovesIsInTheStandardDeviation) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    Sines sines = lateWithNoise(0.5, seed);
    SynchronousRegression rows = regression();
    drive(rows, sines, 0.0, 40.0);
    EXPECT_NEAR(rows.skew()->skew(), sines.late, 3.0 * std::sqrt(rows.skew()->variance()));
  }
}

// All that the strut leaves is noise of both sensors, and that is known.
TEST(SynchronousRegression, WhatKnownNoiseMovesIsTakenBack) {
  double unknown = 0.0, known = 0.0, expected = 0.0;  // mean squares of errors, and mean variance
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const auto error = [&](double noise) {
      Sines sines = lateWithNoise(0.5, seed);
      SynchronousRegression rows = regression();
      rows.setNoise(noise * noise);
      drive(rows, sines, 0.0, 40.0);
      if (noise > 0.0) expected += rows.skew()->variance() / 8.0;
      return rows.skew()->skew() - sines.late;
    };
    unknown += std::pow(error(0.0), 2) / 8.0;
    known += std::pow(error(0.5), 2) / 8.0;
  }
  EXPECT_LT(known, 0.5 * unknown);
  EXPECT_LT(known, 2.2 * expected);  // chi^2 of 8 exceeds 2.2 times its mean in 2 % of cases
}

TEST(SynchronousRegression, AStrutThatChangesTeachesNoSkew) {
  Sines sines;
  SynchronousRegression rows = regression();
  drive(rows, sines, 0.0, 10.0);
  sines.b1 = 0.5 * kB1;
  drive(rows, sines, 10.0, 20.0);
  EXPECT_NEAR(rows.skew()->skew(), 0.0, 2e-4);
}

// A force on the body is no noise of both sensors: it would shift what total least squares finds.
TEST(SynchronousRegression, AnEngineOnTheBodyTeachesNoSkew) {
  for (const double late : {0.0, 0.004}) {
    Sines sines;
    sines.late = late;
    sines.engine = 1.5;
    sines.noise = 0.03;
    SynchronousRegression rows = regression();
    drive(rows, sines, 0.0, 20.0);
    EXPECT_NEAR(rows.skew()->skew(), late, 3e-4);
    EXPECT_NEAR(rows.skew()->skew(), late, 3.0 * std::sqrt(rows.skew()->variance()));
  }
}

// Where the wheel moves by one sine, any skew is that of another strut.
TEST(SynchronousRegression, OneSineTellsNoSkew) {
  SynchronousRegression rows = regression();
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 0.03);
  for (int k = 0; k < 4000; ++k) {
    const std::complex<double> s(0.0, 9.0), wave = std::exp(s * (k * kPeriod));
    const double body = std::real((kB1 * s + kB0) / (s * s + kB1 * s + kB0) * wave);
    const CornerSample sample{Stamp{}, body + noise(random), std::real(wave) + noise(random)};
    if (const RegressionRow* row = rows.push(sample, nullptr)) rows.learnSkew(row->output);
  }
  EXPECT_GT(std::sqrt(rows.skew()->variance()), 1.5e-3);  // 3 ms are usual beforehand
}

TEST(SynchronousRegression, ALargerSkewIsNotWithin) {
  for (const double late : {0.018, -0.018, 0.03}) {
    Sines sines;
    sines.late = late;
    SynchronousRegression rows = regression();
    drive(rows, sines, 0.0, 8.0);
    EXPECT_FALSE(rows.skew()->isWithin()) << late;
  }
}

// Clocks that are set: what was learned before is not averaged with what comes.
TEST(SynchronousRegression, ASkewThatJumpsIsFollowed) {
  Sines sines;
  sines.noise = 0.03;
  SynchronousRegression rows = regression();
  drive(rows, sines, 0.0, 30.0);
  EXPECT_LT(std::sqrt(rows.skew()->variance()), 3e-4);
  sines.late = 0.004;
  drive(rows, sines, 30.0, 42.0);  // a filter's window, and two blocks
  EXPECT_NEAR(rows.skew()->skew(), sines.late, 3.0 * std::sqrt(rows.skew()->variance()));
}

TEST(SynchronousRegression, KeepsTheSkewOverAGapButNotOverADrive) {
  Sines sines;
  sines.late = 0.005;
  SynchronousRegression rows = regression();
  drive(rows, sines, 0.0, 8.0);
  rows.reset();
  EXPECT_NEAR(rows.skew()->skew(), 0.005, 1e-4);
  rows.changeEffects(0);
  EXPECT_NEAR(rows.skew()->skew(), 0.005, 1e-4);
  EXPECT_EQ(rows.push(sines.at(9.0), nullptr), nullptr);
  rows.restart();
  EXPECT_FALSE(rows.skew()->isKnown());
  EXPECT_EQ(rows.skew()->skew(), 0.0);
}

// Effects come with the body's readings, which wait for the wheel's.
TEST(SynchronousRegression, EffectsAreThoseOfTheRow) {
  SynchronousRegression late = regression();
  late.changeEffects(2);
  SuspensionRegression prompt(kFilter, 2, SensorColumns::kDriftingOffset);
  Sines sines;
  std::vector<RegressionRow> expected;
  std::size_t next = 0;
  for (int k = 0; k < 500; ++k) {
    const double t = k * kPeriod, forces[]{std::sin(11.0 * t), std::cos(30.0 * t)};
    const CornerSample sample = sines.at(t);
    if (const RegressionRow* row = prompt.push(sample, forces)) expected.push_back(*row);
    const RegressionRow* row = late.push(sample, forces);
    if (row == nullptr) continue;
    if (next == 0) next = expected.size() - 1 - WheelHistory(kFilter, SkewProfile::mostSkew(kFilter)).delay();
    EXPECT_NEAR(row->output, expected[next].output, 1e-9);
    EXPECT_NEAR((row->regressor - expected[next].regressor).norm(), 0.0, 1e-9);
    ++next;
  }
  EXPECT_GT(next, 200U);
}

TEST(SynchronousRegression, WithoutAColumnOfADriftRowsAreTakenAsTheyAre) {
  SynchronousRegression rows(kFilter, SensorColumns::kNone, RegressorNoise(kFilter), kForgetting);
  SuspensionRegression plain(kFilter);
  Sines sines;
  for (int k = 0; k < 400; ++k) {
    const CornerSample sample = sines.at(k * kPeriod);
    const RegressionRow* expected = plain.push(sample);
    const RegressionRow* row = rows.push(sample, nullptr);
    ASSERT_EQ(row == nullptr, expected == nullptr);
    if (row == nullptr) continue;
    rows.learnSkew(row->output);
    EXPECT_EQ(row->output, expected->output);
    EXPECT_EQ(row->regressor, expected->regressor);
    EXPECT_EQ(rows.wheel().output, plain.wheelOutput());
  }
  EXPECT_EQ(rows.skew(), nullptr);
}

}  // namespace
}  // namespace suspension_health_monitor
