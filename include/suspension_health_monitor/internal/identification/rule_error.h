#pragma once

#include <vector>

#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

namespace suspension_health_monitor {

/// How wrong an integration rule is of what oscillates: rules are right for signals that are slow against the samples,
/// and a wheel that hops at a third of the rate is not.
///
/// A horizon's end adds 1 / (i w) to the integral of exp(i w t), T = 1, and 1/2 + cot(w / 2) / (2 i) + sum c_k exp(-i w
/// k) to its sum with the corrections c_k.
class RuleError {
 public:
  explicit RuleError(const IntegralFilterOptions& filter);

  /// @param w  [rad/sample], in (0, pi].
  /// @return by how much the sum is too large at an end, in phase with the integral and over what that has there [-].
  double at(double w) const;

 private:
  std::vector<double> corrections_;  // c_0, of the newest sample, c_1, ...
};

}  // namespace suspension_health_monitor
