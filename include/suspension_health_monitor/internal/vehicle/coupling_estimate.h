#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/coupling.h"
#include "suspension_health_monitor/internal/vehicle/coupling_rows.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// What the rows of all struts say of their coupling.
struct CouplingEstimate {
  /// Nothing known: every strut alone.
  explicit CouplingEstimate(const CouplingColumns& columns);

  Coupling coupling;
  StrutMatrix stddevs;                             ///< of the ratios
  ForceMatrix force_stddevs;                       ///< of Coupling::forces; infinite of a force that has been still
  StrutVector damping_to_mass, stiffness_to_mass;  ///< b1_i [1/s], b0_i [1/s^2] over the same rows
  /// Of b1_i [1/s], b0_i [1/s^2] where the ratios are not known better than these rows tell them.
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kMostStruts, 2> own_stddevs;
  double condition = HUGE_VAL;  ///< of the columns of all struts, each scaled to 1
  double told_apart = 0.0;  ///< information of the combination of struts that these rows tell least of, over noise's
  int first_alike = 0, second_alike = 0;  ///< the two struts that it is about
  double doubt = HUGE_VAL;  ///< largest rms that these errors give a strut's own acceleration, as a share of it

  /// @return true if the ratios may be relied upon.
  bool isKnown() const;

  /// @return the linear struts.
  std::vector<StrutModel> models() const;

  /// @return the struts between which there is an anti-roll bar.
  std::vector<std::pair<int, int>> bars() const;
};

/// What the struts do of their own is linear in: b1 and b0 of all struts, then two for every bar.
struct OwnUnknowns {
  Eigen::MatrixXd columns;  ///< by unknown, what one of it is as a combination of I_1^2 u, I_0^2 u of all struts
  std::vector<int> place;   ///< the strut that it belongs to
};
OwnUnknowns ownUnknowns(int num_struts, const std::vector<std::pair<int, int>>& bars);

/// @return p_j as a combination of the columns I_1^2 u, I_0^2 u of all struts.
CouplingRow ownColumns(const CouplingEstimate& estimate, int j);

/// @param moments  of rows.
/// @return the moments of p_j, x_k and I_2^2 z_i'', in this order.
CouplingMoments momentsOfStruts(const CouplingEstimate& estimate, const CouplingMoments& moments);

/// @return moments of what the estimate leaves of all I_2^2 z''. Of the readings of one IMU the tops of more than three
/// struts are made exactly: a little is added, so that the moments have an inverse.
StrutMatrix restMomentsOf(const CouplingEstimate& estimate, const CouplingMoments& moments);

/// @return how much what is left of z_i'' and of z_j'' counts in the sum of squares: generalised least squares of
/// several regressions at once (Zellner, Journal of the American Statistical Association 57 (1962), 348-368).
StrutMatrix inverseOf(const StrutMatrix& rest);

/// @return mean square of what the estimate leaves of each I_2^2 z_i''.
StrutVector restOf(const CouplingEstimate& estimate, const CouplingMoments& moments);

/// @param noise  moments of noise whose standard deviation is 1 in every sensor.
/// @return what the sensors' variance would have to be to leave the least of the rests.
double sensorVariance(const CouplingEstimate& estimate, const CouplingMoments& moments, const CouplingMoments& noise);

}  // namespace suspension_health_monitor
