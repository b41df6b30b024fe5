#include "suspension_health_monitor/internal/identification/residual_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

namespace suspension_health_monitor {
namespace {

/// Random moments of (psi, phi_1, phi_0) in units as different as those of rows; `left` is what is in psi beside the
/// strut.
Eigen::Matrix3d moments(std::mt19937& random, double left) {
  std::normal_distribution<double> normal;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 40; ++i) {
    const double damping = 0.1 * normal(random), stiffness = 0.01 * normal(random);
    const Eigen::Vector3d row(9.0 * damping + 63.0 * stiffness + left * normal(random), damping, stiffness);
    sum += row * row.transpose();
  }
  return sum;
}

Eigen::Matrix3d noise(std::mt19937& random) {
  const Eigen::Matrix3d some = moments(random, 0.3);
  return some / some.trace();
}

TEST(ResidualSquares, AreThoseOfEigensSolversOverMagnitudesOfWhatIsLeft) {
  std::mt19937 random(3);
  for (const double left : {3.0, 0.3, 0.03, 3e-3, 3e-4}) {
    for (int trial = 0; trial < 100; ++trial) {
      const Eigen::Matrix3d m = moments(random, left), n = noise(random);
      const ResidualSquares found = ResidualSolver(n).solve(m);
      const Eigen::Vector2d products = m.bottomLeftCorner<2, 1>();
      const double plain = m(0, 0) - products.dot(m.bottomRightCorner<2, 2>().ldlt().solve(products));
      const double least = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(m, n).eigenvalues()[0];
      // Both are differences of numbers of the size of M: the rounding of those, over that of what is left.
      const double tolerance = 1e-13 * m(0, 0) / plain + 1e-12;
      EXPECT_NEAR(found.plain, plain, tolerance * plain) << "left " << left;
      EXPECT_NEAR(found.of_noise, least, 100.0 * tolerance * least) << "left " << left;
    }
  }
}

TEST(ResidualSquares, OfNoiseAloneIsHowMuchOfItThereIs) {
  std::mt19937 random(4);
  const Eigen::Matrix3d n = noise(random);
  // The root is threefold, so that it is known to the third root of the rounding: (1e-16 x the condition of N)^(1/3).
  EXPECT_NEAR(ResidualSolver(n).solve(7.5 * n).of_noise, 7.5, 0.01 * 7.5);
}

TEST(ResidualSquares, NothingLeftIsNothingAndNothingKnownIsNoNumber) {
  std::mt19937 random(5);
  const ResidualSolver solver(noise(random));
  const Eigen::Matrix3d exact = moments(random, 0.0);
  EXPECT_NEAR(solver.solve(exact).plain, 0.0, 1e-12 * exact(0, 0));
  EXPECT_NEAR(solver.solve(exact).of_noise, 0.0, 1e-10);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(std::isfinite(solver.solve(Eigen::Matrix3d::Constant(nan)).plain));
  EXPECT_FALSE(std::isfinite(solver.solve(1e200 * exact).plain));
}

}  // namespace
}  // namespace suspension_health_monitor
