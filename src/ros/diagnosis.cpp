#include "diagnosis.h"

#include <sstream>
#include <stdexcept>

#include "suspension_health_monitor/internal/wording/search_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

std::string spanOf(const std::vector<CornerSample>& samples) {
  std::ostringstream text;
  text.precision(3);
  text << "the last " << (samples.empty() ? 0.0 : toSeconds(samples.back().stamp - samples.front().stamp)) << " s";
  return text.str();
}

void addExtended(const Diagnosis& found, DiagnoseResponse& response) {
  const FittedModel& fit = *found.final_fit;
  response.extended_held_out_rmse = found.extended->held_out_rmse;
  response.extended_fit_percent = found.extended_fit_percent;
  response.damping_to_mass = fit.model.damping_to_mass;
  response.stiffness_to_mass = fit.model.stiffness_to_mass;
  auto stddev = fit.stddev.begin();
  for (const ModelNumber& number : numbersOf(fit.model)) {
    const double uncertainty = *stddev++;
    if (number.kind == ModelNumber::Kind::kCoefficient) {
      response.coefficient_names.push_back(number.name);
      response.coefficients.push_back(number.value);
      response.coefficient_stddevs.push_back(uncertainty);
    } else if (number.kind == ModelNumber::Kind::kShape) {
      response.shape_names.push_back(number.name);
      response.shapes.push_back(number.value);
    }
  }
}

}  // namespace

Diagnosis searchEffects(const SearchTask& task) {
  Diagnosis found = diagnose({task.drive}, task.options);
  if (!found) throw std::runtime_error(spanOf(task.drive.samples) + ' ' + found.reason + ": drive on");
  return found;
}

DiagnoseResponse toResponse(const Diagnosis& found) {
  DiagnoseResponse response;
  response.success = true;
  response.message = found.remainder.empty() ? found.summary : found.summary + ' ' + found.remainder;
  response.verdict = nameOf(found.verdict);
  response.base_held_out_rmse = found.base.held_out_rmse;
  response.base_fit_percent = found.base_fit_percent;
  response.noise_floor = found.noise_floor;
  response.structured_share = found.structured_share;
  response.surface_share = found.surface_share;
  for (const RankedModel& ranked : found.ranking) {
    response.ranked_effects.push_back(join(ranked.effects, " + "));
    response.ranked_held_out_rmse.push_back(ranked.held_out_rmse);
    response.ranked_error_removed_percent.push_back(ranked.error_removed_percent);
    response.ranked_significant.push_back(ranked.significant);
  }
  response.selected = found.selected;
  for (const std::vector<std::string>& group : found.indistinguishable)
    response.indistinguishable.push_back(join(group));
  response.suggested_drive = found.suggested_drive;
  if (found.extended) addExtended(found, response);
  return response;
}

}  // namespace suspension_health_monitor
