#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Ends an integration that leads nowhere, in words that name the hidden effects: one that runs away, or one that needs
/// steps so small that it would not come to an end.
class IntegrationGuard {
 public:
  static constexpr double kTolerance = 1e-10;  ///< per step of an integration, absolute [m, m/s] and relative

  /// @param hidden  effects of the strut, to be named.
  /// @param step  longest step that the strut without them lets the integration make [s].
  IntegrationGuard(const std::vector<ActiveEffect>& hidden, double step);

  /// Counts one evaluation of the equations of motion at time t [s].
  /// @throws std::invalid_argument  if there are more than kMostPerStep for each longest step that fits into 0 .. t.
  void countEvaluation(double t) {
    if (static_cast<double>(++evaluations_) > kGrace + kMostPerStep * t / step_) refuseStiffness(t);
  }

  /// @param position, rate  of body or wheel at time t [m], [m/s].
  /// @throws std::invalid_argument  if one of them is not finite, or beyond kFar.
  void checkMotion(double position, double rate, double t) const {
    if (!(position > -kFar && position < kFar && rate > -kFar && rate < kFar)) refuseMotion(t);
  }

 private:
  static constexpr double kGrace = 1e6;        // evaluations: a tenth of a second's work
  static constexpr double kMostPerStep = 1e4;  // evaluations
  static constexpr double kFar = 1e4;          // [m], [m/s]

  [[noreturn]] void refuseStiffness(double t) const;
  [[noreturn]] void refuseMotion(double t) const;

  std::string hidden_;  // in words; empty: none
  double step_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace suspension_health_monitor
