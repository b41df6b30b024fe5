#include "suspension_health_monitor/internal/wording/cost_sentences.h"

#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLeastShown = 0.001;  // what percent() shows, 0.1 %

std::string describe(const char* number, const std::optional<RelativeChange>& change) {
  if (!change) return std::string("leaves ") + number + " too uncertain to compare";
  if (change->isKnown() && std::abs(change->value) >= kLeastShown)
    return std::string("makes ") + number + " " + percent(std::abs(change->value)) +
           (change->value > 0.0 ? " high" : " low");
  return std::string("moves ") + number + " by less than " + percent(std::max(kLeastShown, change->most()));
}

}  // namespace

std::string describe(const EffectCost& cost) {
  const std::string name = cost.effect + (cost.size.empty() ? "" : " of " + cost.size);
  if (!cost.fits_without) return "No strut fits without " + name + ".";
  return "If left out, " + name + " " + describe("b1", cost.damping) + " and " + describe("b0", cost.stiffness) +
         (cost.isHarmless() ? "; nothing to do." : ".");
}

}  // namespace suspension_health_monitor
