#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/identification/regressor_noise.h"
#include "suspension_health_monitor/internal/identification/residual_squares.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/identification/wheel_history.h"

namespace suspension_health_monitor {

/// By how much the clocks of the two IMUs differ, whatever the strut is: the wheel's readings are moved by step after
/// step, and where the best strut leaves least of psi they are in time.
///
/// Every block of rows has a strut of its own and an offset between the sensors, so that a strut that changes teaches
/// no skew; what the strut leaves so at a skew tau is J(tau). Its likelihood, exp(-D / 2) with D the sum of n J(tau) /
/// J of the best tau, is multiplied over blocks and forgotten slowly. Residuals are correlated by the filter: six of n
/// rows count as one, so that blocks of simulated cars scatter by half of what D says to all of it. The variance is
/// 2 / D''. Rows in which no strut shows have a flat J and tell nothing. Clocks may be set: where the D of the newest
/// block is worse at the estimate than at its own best by 4^2, what is older is forgotten.
///
/// Noise of the sensors is in the regressors, too, and moves the best tau; an engine on the body, or what a strut does
/// that no model has, is not. None of J is such noise for least squares; all of it is for total least squares, whose J
/// is the least that noise of both sensors has to be. The estimate is as far between their best tau as the share of
/// that noise which the sensors are known to have, none before that is known. The truth may be anywhere between them:
/// the variance has the mean square distance from the estimate of a uniform distribution.
///
/// Beforehand half of all skews are within a 200th of the horizon, 3 ms of 0.6 s, and none is out of the question
/// (Cauchy's distribution). Looked for are five of that either way, in steps by which a wheel that hops turns by a
/// tenth of a radian. Cost per row: O(1), as rows a 64th of a horizon apart tell all; no allocation.
class SkewProfile {
 public:
  /// @return the largest skew that is looked for [s].
  static double mostSkew(const IntegralFilterOptions& filter) { return filter.horizon_samples * filter.period / 40.0; }

  /// @param wheel  that reaches as far as mostSkew().  @param forgetting_factor  of the estimator.
  SkewProfile(const WheelHistory& wheel, const IntegralFilterOptions& filter, const RegressorNoise& noise,
              double forgetting_factor);

  /// Takes in a row.
  /// @param body  what I_1^2 and I_0^2 make of z''.
  /// @param output  psi without what effects make of it.
  /// @return true if a horizon of rows is complete: all that follows may have changed.
  bool add(const WheelHistory& wheel, const Eigen::Vector2d& body, double output);

  bool isKnown() const { return found_.has_value(); }  ///< a horizon of rows has been seen

  double skew() const { return found_ ? found_->skew : 0.0; }  ///< by which the wheel's readings are stamped late [s]

  double variance() const { return found_ ? found_->variance : 0.0; }  ///< of skew() [s^2]

  /// @return true if the skew lies within those that are looked for.
  bool isWithin() const { return !found_ || found_->is_within; }

  void setForgettingFactor(double forgetting_factor);

  /// @param variance  of the noise of either sensor, as far as it is known, from now on [(m/s^2)^2].
  void setNoise(double variance) { noise_variance_ = variance; }

  void interrupt();  ///< the next row does not follow the one before

  void restart();  ///< other clocks: nothing is known any more

 private:
  static constexpr int kSteps = 15;  // either way
  static constexpr std::size_t kNumSkews = 2 * kSteps + 1;
  using Profile = Eigen::Array<double, static_cast<int>(kNumSkews), 1>;  // a value for every skew

  static Profile none() { return Profile::Zero(); }

  /// Sums over the rows of a block.
  struct Sums {
    int rows = 0;                                                               // all of them
    double num = 0.0, output = 0.0, output_square = 0.0;                        // of those looked at: 1, psi, psi^2
    Profile damping = none(), stiffness = none();                               // of phi_1, phi_0
    Profile damping_square = none(), stiffness_square = none(), both = none();  // of their products
    Profile damping_output = none(), stiffness_output = none();                 // of those with psi
  };

  /// D by one way to count what a strut leaves.
  struct Evidence {
    Profile newest = none(), older = none();  // of the block, and of those before it

    bool take(const Profile& rests, double weight);
    void closeBlock(double share);
  };

  /// The least of D and of what is known beforehand.
  struct Optimum {
    double skew, variance;
    bool is_within;  // the skews that are looked for
  };

  double skewAt(std::size_t j) const { return (static_cast<double>(j) - kSteps) * step_; }
  Eigen::Matrix3d momentsAt(std::size_t j) const;
  void closeHorizon();
  bool newestAgrees() const;
  Optimum optimumOf(const Evidence& evidence) const;
  void locate();
  void forgetOlder() { plain_.older = of_noise_.older = none(); }

  double step_;  // [s]
  int every_, horizon_rows_;
  double noise_of_psi_;  // what it adds to the square of psi of a row [1 / variance of a sensor]
  ResidualSolver residuals_;
  double share_ = 1.0;  // of a block, that is left at the end of the next one
  std::vector<WheelHistory::Place> places_;
  Profile prior_;  // -2 log of what is known beforehand
  Sums sums_;
  Evidence plain_, of_noise_;  // by least squares and by total least squares
  double noise_variance_ = 0.0;
  RunningMeans<1> noise_share_;  // of the noise that total least squares takes the sensors to have
  std::optional<Optimum> found_;
};

}  // namespace suspension_health_monitor
