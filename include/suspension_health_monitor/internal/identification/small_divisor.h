#pragma once

#include <algorithm>

namespace suspension_health_monitor {

/// What keeps the weight 1/|epsilon| finite when a row is hit (almost) exactly.
enum class SmallDivisor {
  kAbsolute,  ///< |epsilon| >= eps_min in the unit of psi, as in the paper (below Eq. (23))
  kRelative,  ///< |epsilon| >= eps_min times the scale of the residuals: scale-free
};

/// @param smallest  eps_min >= 0, [unit of psi] if absolute, [-] if relative.
/// @param residual_scale  mean |epsilon| >= 0 [unit of psi], only used by the relative rule.
/// @return what |residual| is at least taken for [unit of psi]; at least 1e-100, so that a row hit exactly under a
///         threshold of 0 has a weight whose square is still a number.
inline double smallestDivisor(SmallDivisor rule, double smallest, double residual_scale) {
  return std::max(rule == SmallDivisor::kRelative ? smallest * residual_scale : smallest, 1e-100);
}

}  // namespace suspension_health_monitor
