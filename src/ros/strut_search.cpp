#include "strut_search.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "conversions.h"
#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

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

/// diagnose() of one drive.
/// @throws std::runtime_error  in words for people, if the samples are too short or too poor.
Diagnosis searchEffects(const SearchTask& task) {
  Diagnosis found = diagnose({task.drive}, task.options);
  if (found) return found;
  const std::vector<CornerSample>& samples = task.drive.samples;
  const double span = samples.empty() ? 0.0 : toSeconds(samples.back().stamp - samples.front().stamp);
  throw std::runtime_error(formatted("the last %.3g s ", span) + found.reason + ": drive on");
}

}  // namespace

DiagnoseResponse withoutFigures() {
  DiagnoseResponse response;
  response.base_held_out_rmse = response.base_fit_percent = response.noise_floor = kUnknown;
  response.structured_share = response.surface_share = kUnknown;
  response.extended_held_out_rmse = response.extended_fit_percent = kUnknown;
  response.damping_to_mass = response.stiffness_to_mass = kUnknown;
  return response;
}

DiagnoseResponse toResponse(const Diagnosis& found) {
  DiagnoseResponse response = withoutFigures();
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

double searchSpan(double window, double kept) {
  if (!(window >= 0.0 && window <= kept))
    refuse("window", window, "s", "in [0, " + numberText(kept) + "] (diagnose/window)");
  return window > 0.0 ? window : kept;
}

DiagnoseService<Diagnose>::Search searchOf(SearchTask task, std::function<void(const Diagnosis&)> take) {
  return [task = std::move(task), take = std::move(take)](const SearchProgress& progress) mutable {
    task.options.progress = progress;
    const auto diagnosis = std::make_shared<const Diagnosis>(searchEffects(task));
    return DiagnoseService<Diagnose>::Outcome{toResponse(*diagnosis), [take, diagnosis] { take(*diagnosis); }};
  };
}

}  // namespace suspension_health_monitor
