#pragma once

#include <Eigen/Core>

namespace suspension_health_monitor {

// Eigen's decompositions, compiled once: each takes the compiler seconds wherever it is used.

/// @return the pseudoinverse of A: times B it is the smallest X of those that make |A X - B| least.
Eigen::MatrixXd pseudoInverse(const Eigen::MatrixXd& a);
Eigen::MatrixXcd pseudoInverse(const Eigen::MatrixXcd& a);

/// @return X of A X = B.  @param a  symmetric, not indefinite.
Eigen::MatrixXd solveSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// @return the number of columns of A that are independent.
Eigen::Index rankOf(const Eigen::MatrixXd& a);

}  // namespace suspension_health_monitor
