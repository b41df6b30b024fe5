#pragma once

#include <Eigen/Core>

namespace suspension_health_monitor {

/// A strut (27) of damping ratio 1/2 that follows a measured acceleration, as a source of instruments: what it does
/// depends on that measurement alone, and hardly on what is fast in it. It need not be accurate: the input is taken as
/// constant between samples, and the step over a sample is exact for that.
/// Source: Soederstroem and Stoica (1981), auxiliary model.
/// Cost per sample: a 2 x 2 product, no allocation.
class AuxiliaryStrut {
 public:
  /// @param period  sampling time T [s].
  explicit AuxiliaryStrut(double period) : period_(period) {}

  /// Changes the model; the run goes on from the forces that there are.
  /// @param stiffness_to_mass  b0 > 0 and finite [1/s^2].
  void setModel(double stiffness_to_mass);
  bool hasModel() const { return frequency_ > 0.0; }

  /// Takes in the next sample of an uninterrupted uniform series [m/s^2].
  /// @pre hasModel().
  void push(double acceleration);

  /// (b1 v, b0 d): what damper and spring do to the body; its acceleration is the sum [m/s^2].
  const Eigen::Vector2d& forces() const { return forces_; }

  /// For a gap in the series: starts anew at rest.
  void reset() {
    forces_.setZero();
    last_ = 0.0;
  }

 private:
  double period_;
  double frequency_ = 0.0;                                    // sqrt(b0) = b1 [rad/s]
  Eigen::Matrix2d transition_ = Eigen::Matrix2d::Identity();  // of the forces over a sample
  Eigen::Vector2d forces_ = Eigen::Vector2d::Zero();
  double last_ = 0.0;  // input
};

}  // namespace suspension_health_monitor
