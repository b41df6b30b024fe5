#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/identification/regression_row.h"

namespace suspension_health_monitor {

/// Position of the strut's own parameters in theta, Eq. (30).
enum StrutParameter : int { kDampingToMass = 0, kStiffnessToMass = 1, kNumStrutParameters = 2 };

/// What of the two sensors is estimated beside the strut.
enum class SensorColumns {
  kNone,           ///< nothing, as in the paper
  kOffset,         ///< c_o
  kSkewAndOffsets  ///< tau, c_o of the newest reading and its step from row to row, in this order
};

/// @return how many columns these are.
constexpr int count(SensorColumns columns) {
  return columns == SensorColumns::kNone ? 0 : columns == SensorColumns::kOffset ? 1 : 3;
}

/// Rows of the strut regression from the two accelerations, Eq. (28)-(30), with a column more for every effect:
///   I_2^2 y = b1 I_1^2 u + b0 I_0^2 u + sum_j c_j I_2^2 f_j + c_o h^2 + e,   y = z'' [m/s^2], u = w'' - z'' [m/s^2],
/// with b1 = beta/M [1/s] and b0 = K/M [1/s^2]. It is the model (27) differentiated twice, so that only accelerations
/// occur, under the twofold integral, so that nothing is differentiated in fact.
/// The effects' f_j, per unit of c_j, come from an observer of the travel (free_run.h).
/// A constant in y vanishes from psi; a constant common to both sensors vanishes from u. A constant o in u, the offset
/// between the sensors, adds h^2 o to the column of b0 and vanishes from that of b1; the last column, if it is wanted,
/// takes it out again: c_o = -b0 o. One that drifts by r in a row is that of L rows ago in the middle of the window, so
/// that c_r = -b0 r has the column -L h^2.
/// Readings of the wheel that are stamped tau too late are w''(t - tau): what their change adds to u is
/// tau x + tau^2 / 2 x' + ..., x = b1 I_2^2 w'' + b0 I_1^2 w''. The column of the skew is x + tau / 2 x', by the tau
/// and the strut that are known. Cost per sample: O(1), no allocation.
class SuspensionRegression {
 public:
  explicit SuspensionRegression(const IntegralFilterOptions& options, std::size_t num_effects = 0,
                                SensorColumns sensors = SensorColumns::kNone);

  /// @param strut  (b1 [1/s], b0 [1/s^2]) and tau [s] that the column of the skew is made of from the next row on; 0 so
  /// far.
  void setStrut(const Eigen::Vector2d& strut, double skew) {
    strut_ = strut;
    known_skew_ = skew;
  }

  /// Takes in the next sample of a uninterrupted uniform series (only the accelerations are used).
  /// @param effect_forces  f_j at this sample, one per effect.
  /// @return the row, owned by this object and valid until the next call; nullptr while the filter fills (2 L samples).
  const RegressionRow* push(const CornerSample& sample, const double* effect_forces = nullptr);

  /// @return what psi of the newest row would be of the wheel's own acceleration: I_2^2 w'' [m/s^2].
  double wheelOutput() const { return row_.output + relative_.output(2); }

  /// What a reading of the wheel that is stamped tau late makes of psi: x tau + x' tau^2 / 2 + ...
  struct Skew {
    double column = 0.0, step = 0.0;  ///< x, and what it has changed by since the row before [m/s^3]
  };

  /// @return that of the newest row.
  const Skew& skew() const { return skew_; }

  /// Starts anew after a gap.
  void reset();

 private:
  void keepWheel();
  void fillSensors(double* column);

  LinearIntegralFilter sprung_;
  LinearIntegralFilter relative_;
  std::vector<LinearIntegralFilter> effects_;
  SensorColumns sensors_;
  double offset_gain_;  // h^2 [s^2]
  double drift_rows_;   // L
  double period_;       // [s]
  Eigen::Vector2d strut_ = Eigen::Vector2d::Zero();
  double known_skew_ = 0.0;
  Skew skew_;
  std::array<Eigen::Vector2d, 3> wheel_;  // I_2^2 w'', I_1^2 w'' of the newest rows, the newest first
  bool has_wheel_ = false;
  RegressionRow row_;
};

}  // namespace suspension_health_monitor
