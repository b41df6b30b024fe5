#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

namespace suspension_health_monitor {

/// What keeps the weight 1/|epsilon| finite when a row is hit (almost) exactly.
enum class SmallDivisor {
  kAbsolute,  ///< |epsilon| >= eps_min in the unit of psi, as in the paper (below Eq. (23))
  kRelative,  ///< |epsilon| >= eps_min times the scale of the residuals: scale-free
};

inline constexpr std::string_view kSmallDivisorNames = "absolute relative";

/// @param smallest  eps_min >= 0, [unit of psi] if absolute, [-] if relative.
/// @param residual_scale  mean |epsilon| >= 0 [unit of psi], only used by the relative rule.
/// @return max(|residual|, threshold) [unit of psi], at least 1e-100, so that a row hit exactly under a threshold of 0
///         has a weight whose square is still a number.
inline double boundedDivisor(double residual, SmallDivisor rule, double smallest, double residual_scale) {
  const double threshold = rule == SmallDivisor::kRelative ? smallest * residual_scale : smallest;
  return std::max({std::abs(residual), threshold, 1e-100});
}

}  // namespace suspension_health_monitor
