// The spline through readings at any positions, against the dense normal equations and against what no penalty moves.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "suspension_health_monitor/internal/signal/stream_resampler.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPenalty = 4e-6;

double bspline(double u) {
  const double x = std::abs(u);
  if (x >= 2.0) return 0.0;
  return x >= 1.0 ? std::pow(2.0 - x, 3) / 6.0 : (4.0 - 6.0 * x * x + 3.0 * x * x * x) / 6.0;
}

std::vector<double> positions(double spacing, double jitter, int count, double start = 0.0) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(0.0, jitter);
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(start + i * spacing + uniform(engine));
  return all;
}

/// Coefficients `first`.. of the spline through the readings, all at once.
Eigen::VectorXd dense(const std::vector<double>& u, const std::vector<double>& x, long first, long size) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size), row(size);
  const auto take = [&](const Eigen::VectorXd& of, double value, double weight) {
    matrix += weight * of * of.transpose();
    right += weight * of * value;
  };
  for (std::size_t i = 0; i < u.size(); ++i) {
    for (long k = 0; k < size; ++k) row[k] = bspline(u[i] - static_cast<double>(first + k));
    take(row, x[i], 1.0);
  }
  const auto penalise = [&](long k, const Eigen::VectorXd& difference) {
    row.setZero();
    row.segment(k, difference.size()) = difference;
    take(row, 0.0, kPenalty);
  };
  penalise(0, Eigen::Vector3d(1.0, -2.0, 1.0));
  const Eigen::Vector4d third(-1.0, 3.0, -3.0, 1.0);
  for (long k = 0; k + 4 <= size; ++k) penalise(k, k == 0 ? third : 1.4 * third);
  Eigen::VectorXd fourth(5);
  fourth << 1.0, -4.0, 6.0, -4.0, 1.0;
  for (long k = 0; k + 5 <= size; ++k) penalise(k, fourth);
  return matrix.ldlt().solve(right);
}

TEST(SmoothingSpline, SolvesTheNormalEquations) {
  for (const double spacing : {0.4, 1.2, 2.0, 3.0}) {
    const std::vector<double> u = positions(spacing, 0.8 * spacing, static_cast<int>(60 / spacing), 5.3);
    std::vector<double> x;
    SmoothingSpline spline;
    for (const double position : u) {
      x.push_back(std::sin(0.7 * position) + std::cos(2.0 * position));
      spline.add(position, x.back());
    }
    const long first = static_cast<long>(std::floor(u.front())) - 1, last = static_cast<long>(std::floor(u.back())) + 3;
    const Eigen::VectorXd expected = dense(u, x, first, last - first + 1);
    spline.solve(first, first - 1);
    for (long k = 0; k < expected.size(); ++k)
      ASSERT_NEAR(spline.coefficients(first)[k], expected[k], 1e-9) << spacing << " " << k;
  }
}

double valueAt(const SmoothingSpline& spline, long knot) {
  const double* c = spline.coefficients(knot - 1);
  return (c[0] + 4.0 * c[1] + c[2]) / 6.0;
}

// Third differences of a parabola are none. Its curvature where the series begins is lost by then.
TEST(SmoothingSpline, PassesAParabolaWhateverTheSpacing) {
  const auto parabola = [](double u) { return 3.0 - 0.2 * u + 0.01 * u * u; };
  for (const double spacing : {0.3, 1.0, 2.0, 5.0, 9.0}) {
    SmoothingSpline spline;
    for (const double u : positions(spacing, 0.9 * spacing, static_cast<int>(400 / spacing), -300.0))
      spline.add(u, parabola(u));
    spline.solve(50, 49);
    for (int knot = 51; knot < 60; ++knot) EXPECT_NEAR(valueAt(spline, knot), parabola(knot), 1e-4) << spacing;
  }
}

TEST(SmoothingSpline, PutsAStraightLineThroughTwoReadings) {
  SmoothingSpline spline;
  spline.add(10.25, 1.0);
  spline.add(70.75, 3.0);
  spline.solve(9, 8);
  for (int knot = 10; knot < 72; ++knot)
    EXPECT_NEAR(valueAt(spline, knot), 1.0 + 2.0 * (knot - 10.25) / 60.5, 1e-5) << knot;
}

// Readings every other knot are the sparsest there may be for long. The response to one falls by 0.43 from reading to
// reading, as that of the quintic interpolating spline, which third differences make (its poles: Unser, IEEE Signal
// Processing Magazine 16 (1999), 22-38, table 1).
TEST(SmoothingSpline, LaterReadingsChangeLittle) {
  SmoothingSpline spline;
  for (int i = 0; i <= 100; ++i) spline.add(2.0 * i, 0.0);
  for (int lag = 1; lag <= 12; ++lag) {
    SmoothingSpline with = spline;
    for (int i = 1; i <= lag; ++i) with.add(200.0 + 2.0 * i, i == lag ? 1.0 : 0.0);
    with.solve(190, 189);
    EXPECT_LT(std::abs(valueAt(with, 199)), 2.0 * std::pow(0.4306, lag)) << lag;
  }
}

TEST(SmoothingSpline, LeavesWhatIsSettledAsItIs) {
  SmoothingSpline spline;
  for (int i = 0; i <= 20; ++i) spline.add(i, std::sin(0.3 * i));
  spline.solve(0, 10);
  const double settled = spline.coefficients(10)[0], open = spline.coefficients(11)[0];
  for (int i = 21; i <= 24; ++i) spline.add(i, 5.0);
  spline.solve(0, 12);
  EXPECT_EQ(spline.coefficients(10)[0], settled);
  EXPECT_NE(spline.coefficients(11)[0], open);
}

}  // namespace
}  // namespace suspension_health_monitor
