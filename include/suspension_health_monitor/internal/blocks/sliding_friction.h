#pragma once

#include <optional>

namespace suspension_health_monitor {

/// The direction of dry friction, -1 to 1, in a strut that the wheel alone drives:
///     d'' = w'' - b1 d' - b0 d - f direction,  d = w - z.
/// Coulomb's law by implicit Euler steps, in which the strut sticks where a smaller force than f stops it. The wheel's
/// acceleration is straight between readings, and free of its slow mean, which a sensor's offset is part of.
/// Cost per reading: O(spacing / step), no allocation.
class SlidingFriction {
 public:
  /// @param longest_step  of the integration [s].  @param memory  of the slow mean and the size of the wheel's motion
  /// [s].
  SlidingFriction(double longest_step, double memory) : longest_step_(longest_step), memory_(memory) {}

  /// @param length  of the blocks [s].
  static SlidingFriction ofBlocks(double length) {
    constexpr double kSteps = 4096.0;  // per block: a thousand and more per bounce
    constexpr double kBlocks = 2.0;    // memory of the slow mean
    return {length / kSteps, kBlocks * length};
  }

  /// @param friction  f [m/s^2].
  void setStrut(double b1, double b0, double friction) {
    b1_ = b1;
    b0_ = b0;
    friction_ = friction;
  }

  /// @param time  later than the last one [s].  @param wheel  w'' [m/s^2].
  /// @return the direction at that time.
  double push(double time, double wheel);

  void restart() { time_.reset(); }

 private:
  double longest_step_, memory_;
  double b1_ = 1.0, b0_ = 1.0, friction_ = 0.0;
  std::optional<double> time_;
  double wheel_ = 0.0, mean_ = 0.0, variance_ = 0.0;
  double travel_ = 0.0, rate_ = 0.0;
};

}  // namespace suspension_health_monitor
