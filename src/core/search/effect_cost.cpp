#include "suspension_health_monitor/internal/search/effect_cost.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

/// @return the model that was fitted with all that was found but these; none: there is no such fit.
const RankedModel* without(const Diagnosis& found, const std::vector<std::string>& left_out) {
  std::vector<std::string> names;
  for (const std::string& name : found.extended->effects)
    if (std::find(left_out.begin(), left_out.end(), name) == left_out.end()) names.push_back(name);
  const auto has = [&](const RankedModel& model) {
    return model.fitted && model.failure == FitFailure::kNone && model.effects.size() == names.size() &&
           std::is_permutation(names.begin(), names.end(), model.effects.begin());
  };
  if (has(found.base)) return &found.base;
  const auto ranked = std::find_if(found.ranking.begin(), found.ranking.end(), has);
  return ranked == found.ranking.end() ? nullptr : &*ranked;
}

std::optional<Measured> changeOf(double without, double with, double stddev) {
  if (!(with > kLikely * stddev)) return std::nullopt;
  return Measured{without / with - 1.0, stddev / with};
}

EffectCost costOf(const Diagnosis& found, const RankedModel& before, const std::vector<std::string>& left_out) {
  EffectCost cost;
  cost.effect = join(left_out, " and ");
  const FittedModel& final_fit = *found.final_fit;
  for (const ActiveMeasurementEffect& reading : final_fit.model.reading) {
    if (left_out != std::vector<std::string>{reading.effect.name}) continue;
    cost.advice = reading.effect.advice;
    const std::string& unit = reading.effect.coefficients.front().unit;
    const double c = reading.coefficients.front();
    if (reading.coefficients.size() == 1)
      cost.size = unit == "-" ? formatted("%.3g", c) : ReadableUnit(std::abs(c), unit)(c);
  }
  cost.fits_without = &before != &found.base || found.base_fit_percent > 0.0;  // else b1 and b0 are rough
  const StrutModel &less = before.model, &more = found.extended->model;
  const double scale = final_fit.all_samples ? std::sqrt(1.5) : 1.0;  // to two thirds of the samples
  cost.damping = changeOf(less.damping_to_mass, more.damping_to_mass, scale * final_fit.stddev[0]);
  cost.stiffness = changeOf(less.stiffness_to_mass, more.stiffness_to_mass, scale * final_fit.stddev[1]);
  return cost;
}

}  // namespace

bool EffectCost::isHarmless() const {
  const auto is_small = [](const auto& change) { return change && change->most() < kLeastDifference; };
  return !advice.empty() && fits_without && is_small(damping) && is_small(stiffness);
}

std::vector<EffectCost> costsOf(const Diagnosis& found) {
  std::vector<EffectCost> costs;
  if (!found.extended || !found.final_fit) return costs;
  for (const std::string& effect : found.selected)
    if (const RankedModel* before = without(found, {effect})) costs.push_back(costOf(found, *before, {effect}));
  if (costs.size() < found.selected.size()) costs.push_back(costOf(found, found.base, found.selected));
  return costs;
}

}  // namespace suspension_health_monitor
