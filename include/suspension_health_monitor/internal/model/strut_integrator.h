#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "suspension_health_monitor/internal/signal/filters.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Travel, travel rate and the memories of the effects.
struct StrutState {
  double travel = 0.0;       ///< d [m]
  double travel_rate = 0.0;  ///< v [m/s]
  std::array<Memory, kMostEffects> memory{};
};

/// What the wheel does during one integration step, beyond going on with the speed that it had: the gains of its
/// position [m] and velocity [m/s] by the middle and by the end of the step.
struct WheelStep {
  double middle_position = 0.0, middle_velocity = 0.0, end_position = 0.0, end_velocity = 0.0;
};

/// Longest step of integrateStrut(), in units of the strut's fastest time, the smaller of 1/b1 and 1/sqrt(b0): keeps
/// the error of a step below 1e-4.
inline constexpr double kLongestStrutStep = 0.35;
inline constexpr int kMostStepsPerSample = 32;

/// @param period  sampling time T [s].
/// @return how many of the longest steps a sample of the linear strut takes.
inline double stepsPerSample(double damping_to_mass, double stiffness_to_mass, double period) {
  return period * std::max(damping_to_mass, std::sqrt(stiffness_to_mass)) / kLongestStrutStep;
}

/// @return true if the steps of a sample can follow the linear strut.
inline bool canFollow(const StrutModel& model, double period) {
  return stepsPerSample(model.damping_to_mass, model.stiffness_to_mass, period) <= kMostStepsPerSample;
}

/// @return how fast the slowest free motion of the linear strut decays [1/s].
inline double slowestDecay(double damping_to_mass, double stiffness_to_mass) {
  const double half = damping_to_mass / 2, discriminant = half * half - stiffness_to_mass;
  return discriminant > 0.0 ? stiffness_to_mass / (half + std::sqrt(discriminant)) : half;  // of two real roots
}

/// Turns samples of w'' into wheel steps.
class WheelInterpolator {
 public:
  static constexpr int kWidth = 2 * kInterpolationReach;

  /// @param from, to  ends of the step in samples, 0 <= from < to <= 1.  @param period  T [s].
  WheelInterpolator(double from, double to, double period);

  /// @return for every one of the steps in which a sample is taken.
  static std::vector<WheelInterpolator> ofSample(int steps, double period);

  /// @param around  kWidth samples of w'' [m/s^2], the oldest first; the step begins `from` after number kWidth / 2
  /// - 1.
  WheelStep operator()(const double* around) const {
    if (!is_whole_) return ofPart(around);
    // From sample to sample the middle follows from the ends, whose accelerations are known: half the sums. Position by
    // the polynomial of fifth degree through position, velocity and acceleration at both ends.
    const auto [position, velocity] = sums<2>(around);
    const double* const ends = around + kWidth / 2 - 1;
    const double rise = period_ * velocity, square = period_ * period_;
    return {position / 2 - 5.0 / 32 * rise + square / 64 * (ends[0] + ends[1]),
            (15.0 / 8 * position - 7.0 / 16 * rise + square / 32 * (ends[1] - ends[0])) / period_, position, velocity};
  }

 private:
  /// The first kRows of the end's position and velocity, the middle's position and velocity.
  template <int kRows>
  std::array<double, kRows> sums(const double* around) const {
    Eigen::Array<double, 2, kRows> pairs = Eigen::Array<double, 2, kRows>::Zero();
#pragma GCC unroll 12  // counting would cost a third of the sums; a compiler that does not know it may go on
    for (Eigen::Index i = 0; i < kWidth / 2; ++i) {
      const Eigen::Array2d pair(around[2 * i], around[2 * i + 1]);
      for (Eigen::Index row = 0; row < kRows; ++row) pairs.col(row) += weights_.col(4 * i + row) * pair;
    }
    std::array<double, kRows> totals;
    for (Eigen::Index row = 0; row < kRows; ++row) totals[row] = pairs(0, row) + pairs(1, row);
    return totals;
  }

  WheelStep ofPart(const double* around) const;  // elsewhere: together the two would not fit into registers

  bool is_whole_;
  double period_;
  Eigen::Array<double, 2, 2 * kWidth> weights_;  // of two samples for the four numbers, then of the next two
};

/// One step of the strut under the wheel's motion:
///   d'' = w'' - z''(d, v, t, s),   s_j' = g_j.
/// Only the body's part of the motion is integrated numerically (classical Runge-Kutta); the wheel's part, which
/// oscillates much faster, comes in as what it exactly is in the middle and at the end. A step is taken in parts where
/// a memory forgets faster than that, by as many as 32.
/// @pre model.effects.size() <= kMostEffects.
void integrateStrut(const StrutModel& model, double time, double step, const WheelStep& wheel, StrutState& state);

/// The memories of the effects where the motion is known, as an observer knows it: s_j' = g_j along straight lines of
/// travel, travel rate and body acceleration from one instant to another.
/// @param step  between the instants [s].  @param memory  at the first, then at the second.
void followMemories(const StrutModel& model, const StrutMotion& from, const StrutMotion& to, double step,
                    std::array<Memory, kMostEffects>& memory);

/// What a rest makes of the memories: those that last (ForceEffect::lasts) go on by s' = g at rest, of the others
/// nothing is left.
/// @param rest  [s]; below 0 or not finite: unknown, nothing is left.
void keepLasting(const StrutModel& model, double rest, std::array<Memory, kMostEffects>& memory);

}  // namespace suspension_health_monitor
