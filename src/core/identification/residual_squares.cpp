#include "suspension_health_monitor/internal/identification/residual_squares.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace suspension_health_monitor {
namespace {

constexpr int kMostIterations = 50;
constexpr double kConverged = 1e-14;  // of the root

/// @return det(A) A^-1 of a symmetric matrix.
Eigen::Matrix3d adjugate(const Eigen::Matrix3d& a) {
  Eigen::Matrix3d result;
  result << a.row(1).cross(a.row(2)), a.row(2).cross(a.row(0)), a.row(0).cross(a.row(1));
  return result;
}

double traceOfProduct(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

ResidualSolver::ResidualSolver(const Eigen::Matrix3d& noise)
    : noise_(noise), noise_adjugate_(adjugate(noise)), noise_determinant_(noise.determinant()) {}

ResidualSquares ResidualSolver::solve(const Eigen::Matrix3d& moments) const {
  const Eigen::Matrix3d minors = adjugate(moments);
  const double determinant = moments.row(0).dot(minors.row(0));
  const double slope = traceOfProduct(minors, noise_), curve = traceOfProduct(moments, noise_adjugate_);
  // All roots are real, so that Newton's method, begun below the least, rises to it.
  double root = 0.0;
  for (int i = 0; determinant > 0.0 && i < kMostIterations; ++i) {
    const double value = determinant - root * (slope - root * (curve - root * noise_determinant_));
    const double fall = slope - root * (2.0 * curve - root * 3.0 * noise_determinant_);
    const double step = value / fall;
    root += step;
    if (!(step > kConverged * root)) break;
  }
  return {determinant / minors(0, 0), root};
}

}  // namespace suspension_health_monitor
