#pragma once

#include <Eigen/Core>
#include <vector>

#include "suspension_health_monitor/internal/identification/suspension_regression.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What stands where in a row of all struts of a vehicle: I_1^2 u_j, I_0^2 u_j, I_2^2 x_k, I_2^2 z_i''.
struct CouplingColumns {
  int struts = 0, forces = 0;

  int numOwn() const { return 2 * struts; }            ///< I_1^2 u_j, then I_0^2 u_j
  int numInputs() const { return numOwn() + forces; }  ///< these and I_2^2 x_k
  int size() const { return numInputs() + struts; }

  int damping(int strut) const { return strut; }
  int stiffness(int strut) const { return struts + strut; }
  int force(int k) const { return numOwn() + k; }
  int output(int strut) const { return numInputs() + strut; }
};

inline constexpr int kMostCouplingColumns = 3 * kMostStruts + kMostKnownForces;
using CouplingRow = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostCouplingColumns, 1>;
using CouplingMoments =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostCouplingColumns, kMostCouplingColumns>;

/// The rows of all struts of a vehicle, by integral filters of one horizon. A known force counts from its first value:
/// one that never changes moves nothing. Cost per sample: O(struts), no allocation.
class CouplingRows {
 public:
  CouplingRows(const CouplingColumns& columns, const IntegralFilterOptions& filter);

  /// @param sample  the next one of an uninterrupted uniform series.
  /// @return its row, valid until the next call; nullptr while the filters fill.
  const CouplingRow* push(const VehicleSample& sample);

  /// After a gap.
  void startNewSeries();

 private:
  CouplingColumns columns_;
  std::vector<SuspensionRegression> struts_;
  std::vector<LinearIntegralFilter> forces_;
  ForceVector first_forces_;  // empty before the first sample
  CouplingRow row_;
};

/// @return sum of row row' over the rows that follow one wrong reading of every sensor: what white noise of that size
/// makes of the mean of row row'.
CouplingMoments momentsOfNoise(const CouplingColumns& columns, const IntegralFilterOptions& filter,
                               const SensorNoise& noise);

}  // namespace suspension_health_monitor
