#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/identification/wheel_history.h"

namespace suspension_health_monitor {

/// By how much the clocks of the two IMUs differ, whatever the strut is: the wheel's readings are moved by kStep after
/// kStep, and where the best strut leaves least of psi they are in time.
///
/// Every horizon of rows has a strut of its own and an offset between the sensors, so that a strut that changes teaches
/// no skew; what the strut leaves at a skew tau is J(tau). Its likelihood, exp(-D / 2) with D the sum of n J(tau) / J
/// of the best tau, is multiplied over horizons and forgotten slowly. Residuals are correlated by the filter: 64 rows
/// of a horizon count as n = 8 (those of simulated cars scatter like 20 to 60). The variance of the estimate is (2 D''
/// + S) / D''^2: 2 D'' is that of the score D' by likelihood, S what horizons have differed by from the estimate before
/// them, as those of clocks that drift or jump do. Rows in which no strut shows are flat and tell nothing.
///
/// Beforehand a skew is 0 with the standard deviation kUsualSkew.
/// Cost per row: O(1), as rows a 64th of a horizon apart tell all; no allocation.
class SkewProfile {
 public:
  static constexpr double kMostSkew = 0.015;   ///< that is looked for [s]
  static constexpr double kStep = 0.001;       ///< [s]: a wheel that hops turns by a tenth of a radian in it
  static constexpr double kUsualSkew = 0.0075; ///< [s]: beyond kMostSkew once in twenty times

  /// @param horizon_samples  L of the filter.  @param forgetting_factor  of the estimator.
  SkewProfile(const WheelHistory& wheel, int horizon_samples, double forgetting_factor);

  /// Takes in a row.
  /// @param body  what I_1^2 and I_0^2 make of z''.
  /// @param output  psi without what effects make of it.
  /// @return true if a horizon of rows is complete: all that follows may have changed.
  bool add(const WheelHistory& wheel, const Eigen::Vector2d& body, double output);

  bool isKnown() const { return horizons_ > 0; }  ///< a horizon of rows has been seen

  double skew() const { return skew_; }  ///< by which the wheel's readings are stamped late [s]

  double variance() const { return variance_; }  ///< of skew() [s^2]

  /// @return true if the skew lies within those that are looked for.
  bool isWithin() const { return is_within_; }

  void setForgettingFactor(double forgetting_factor);

  void interrupt() { clear(); }  ///< the next row does not follow the one before

  void restart();  ///< other clocks: nothing is known any more

 private:
  static constexpr std::size_t kNumSkews = 2 * static_cast<std::size_t>(kMostSkew / kStep + 0.5) + 1;
  using Profile = std::array<double, kNumSkews>;

  /// Sums over the rows at one skew.
  struct Sums {
    double damping = 0.0, stiffness = 0.0;                            // of phi_1, phi_0
    double damping_square = 0.0, stiffness_square = 0.0, both = 0.0;  // of their products
    double damping_output = 0.0, stiffness_output = 0.0;              // of those with psi
  };

  void clear();
  double rest(const Sums& sums) const;
  void closeHorizon();
  void locate();

  std::vector<WheelHistory::Place> places_;
  int every_, horizon_rows_;
  double share_ = 1.0;  // of a horizon, that is left at the end of the next one
  std::array<Sums, kNumSkews> sums_;
  double output_ = 0.0, output_square_ = 0.0, num_ = 0.0;
  int rows_ = 0;
  Profile misfit_{};      // D
  double scatter_ = 0.0;  // S [1/s^2]
  int horizons_ = 0;
  double skew_ = 0.0, variance_ = kUsualSkew * kUsualSkew;
  bool is_within_ = true;
};

}  // namespace suspension_health_monitor
