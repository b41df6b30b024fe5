#pragma once

#include <Eigen/Core>

#include "suspension_health_monitor/identification/linear_integral_filter.h"
#include "suspension_health_monitor/model/free_run.h"

namespace suspension_health_monitor {

/// Instruments for the strut regression (28)-(30) from an auxiliary model: equation (27) with a rough b1, b0, driven by
/// the measured wheel acceleration alone. Its relative acceleration passes the same filter as the measured one:
///   z = [I_1^2 u_aux  I_0^2 u_aux]',   u_aux = w'' - z''_aux.
/// z is free of the noise on the body's sensor, which is in phi and in e; that of the wheel's sensor stays in it.
/// Source: Soederstroem and Stoica (1981).
/// Cost per sample: O(1), no allocation.
class AuxiliaryInstruments {
 public:
  /// @param options  those of the regression.
  explicit AuxiliaryInstruments(const IntegralFilterOptions& options);

  /// @return true if setModel() takes the values, see FreeRun.
  bool accepts(double damping_to_mass, double stiffness_to_mass) const;

  /// Changes the auxiliary model; the run goes on.
  /// @param damping_to_mass  b1 [1/s].  @param stiffness_to_mass  b0 [1/s^2].
  /// @throws std::invalid_argument  naming the value that makes the model unstable.
  void setModel(double damping_to_mass, double stiffness_to_mass);

  /// Takes in the next w'' [m/s^2] of an uninterrupted uniform series.
  /// @return z for the sample FreeRun::kDelay before this one, (2), owned by this object and valid until the next call;
  ///         nullptr before a model is set and while the filter fills: 2 L samples after the first that the model
  ///         predicts.
  const Eigen::VectorXd* push(double unsprung_acceleration);

  /// Starts anew after a gap, with the same model.
  void reset();

 private:
  FreeRun auxiliary_;
  LinearIntegralFilter relative_;
  Eigen::VectorXd instrument_;
};

}  // namespace suspension_health_monitor
