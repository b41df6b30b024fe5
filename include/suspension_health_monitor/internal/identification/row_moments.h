#pragma once

#include <Eigen/Core>

namespace suspension_health_monitor {

/// A strut, and how much of the rows' output it leaves.
struct StrutFit {
  Eigen::Vector2d theta;  ///< (b1 [1/s], b0 [1/s^2])
  double rest;            ///< sum of (psi - phi' theta)^2, >= 0 [(m/s^2)^2]
};

/// Second moments of rows (phi_1, phi_0, psi) of the strut regression: all that least squares needs of them.
struct RowMoments {
  double damping_information = 0.0;    ///< sum of phi_1^2
  double stiffness_information = 0.0;  ///< sum of phi_0^2
  double between = 0.0;                ///< sum of phi_1 phi_0
  double damping_output = 0.0;         ///< sum of phi_1 psi
  double stiffness_output = 0.0;       ///< sum of phi_0 psi
  double output = 0.0;                 ///< sum of psi^2

  void add(double phi_1, double phi_0, double psi) {
    damping_information += phi_1 * phi_1;
    stiffness_information += phi_0 * phi_0;
    between += phi_1 * phi_0;
    damping_output += phi_1 * psi;
    stiffness_output += phi_0 * psi;
    output += psi * psi;
  }

  RowMoments& operator+=(const RowMoments& other);

  /// @return the strut that leaves least of the output, of those with either parameter between 0 and `most`'s.
  StrutFit bestStrut(const Eigen::Vector2d& most) const;
};

}  // namespace suspension_health_monitor
