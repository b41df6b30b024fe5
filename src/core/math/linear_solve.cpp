#include "suspension_health_monitor/internal/math/linear_solve.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace suspension_health_monitor {

Eigen::MatrixXd pseudoInverse(const Eigen::MatrixXd& a) { return a.completeOrthogonalDecomposition().pseudoInverse(); }

Eigen::MatrixXcd pseudoInverse(const Eigen::MatrixXcd& a) {
  return a.completeOrthogonalDecomposition().pseudoInverse();
}

Eigen::MatrixXd solveSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a.ldlt().solve(b); }

Eigen::Index rankOf(const Eigen::MatrixXd& a) { return a.completeOrthogonalDecomposition().rank(); }

}  // namespace suspension_health_monitor
