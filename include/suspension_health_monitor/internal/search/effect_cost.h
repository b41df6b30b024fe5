#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

/// What an effect that was found does to b1 and b0 if a model leaves it out.
struct EffectCost {
  std::string effect;        ///< of all together their names
  std::string size;          ///< of a sensor's fault with one coefficient, in words: "1.2 ms"; else empty
  std::string advice;        ///< of a sensor's fault
  bool fits_without = true;  ///< false: no strut fits without it, and the changes are unknown
  /// By how much b1 and b0 change, as shares of them; nothing: too uncertain for a share of it.
  std::optional<Measured> damping, stiffness;

  bool isHarmless() const;  ///< a sensor's fault that moves neither by 5 %: there is nothing to do
};

/// @return by effect of Diagnosis::selected, from the fits with it and without it to the same two thirds of the drives;
/// if there is no fit without one of them, at last also of all together.
/// The difference of a fit with more parameters and of one with fewer has at most the variance of the former: Hausman,
/// "Specification tests in econometrics", Econometrica 46 (1978).
std::vector<EffectCost> costsOf(const Diagnosis& found);

}  // namespace suspension_health_monitor
