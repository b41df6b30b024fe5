#include "diagnosis.h"

#include <sstream>
#include <stdexcept>

#include "search_words.h"
#include "suspension_health_monitor/identification/suspension_regression.h"

namespace suspension_health_monitor {
namespace {

std::string spanOf(const DriveSamples& samples) {
  std::ostringstream text;
  text.precision(3);
  text << "the last " << (samples.empty() ? 0.0 : toSeconds(samples.back().stamp - samples.front().stamp)) << " s";
  return text.str();
}

void addExtended(const SearchResult& result, DiagnoseResponse& response) {
  const ModelFit& fit = *result.final_fit;
  response.extended_held_out_rmse = result.extended->held_out_rmse;
  response.extended_fit_percent = result.extended_fit_percent;
  response.damping_to_mass = fit.model.damping_to_mass;
  response.stiffness_to_mass = fit.model.stiffness_to_mass;
  Eigen::Index i = kNumStrutParameters;  // of stddev, which goes effect by effect, shapes included
  const auto addCoefficient = [&](const std::string& name, double value) {
    response.coefficient_names.push_back(name);
    response.coefficients.push_back(value);
    response.coefficient_stddevs.push_back(fit.stddev[i++]);
  };
  for (const ActiveEffect& active : fit.model.effects) {
    addCoefficient(active.effect.name, active.coefficient);
    for (std::size_t k = 0; k < active.shapes.size(); ++k, ++i) {
      response.shape_names.push_back(active.effect.name + '/' + active.effect.shapes[k].name);
      response.shapes.push_back(active.shapes[k]);
    }
  }
  for (const ActiveMeasurementEffect& reading : fit.model.reading)
    for (std::size_t k = 0; k < reading.coefficients.size(); ++k)
      addCoefficient(nameOfCoefficient(reading.effect, k), reading.coefficients[k]);
}

StrutModel roughStrut(const SearchTask& task) {
  StrutModel rough = roughModel(std::vector<DriveSamples>{task.samples}, task.options);
  if (!isDampedSpring(rough))
    throw std::runtime_error(spanOf(task.samples) + " show no damped spring yet (least squares: damping/mass " +
                             std::to_string(rough.damping_to_mass) + ", stiffness/mass " +
                             std::to_string(rough.stiffness_to_mass) + "): drive on");
  return rough;
}

}  // namespace

Diagnosis searchEffects(const SearchTask& task, const SearchOptions& options, const EffectSearch::Progress& progress) {
  const std::vector<DriveSamples> drives{task.samples};
  const StrutModel start = task.model ? *task.model : roughStrut(task);
  std::deque<DriveRecord> records = makeRecords(drives, *task.options.sample_period, start);
  records.front().addBodyMotion(task.body);
  EffectLibrary library = task.library;
  takeUntestable(library, pointersTo(records));
  std::optional<SearchResult> result = EffectSearch(library, options).run(pointersTo(records), start, progress);
  if (!result)
    throw std::runtime_error(spanOf(task.samples) +
                             " are too short to hold a part of them out, or no stable model fits them: drive on");
  return {std::move(*result), task.samples.front().stamp, task.samples.back().stamp};
}

DiagnoseResponse toResponse(const SearchResult& result) {
  DiagnoseResponse response;
  response.success = true;
  response.message = sentence(result);
  response.verdict = nameOf(result.verdict);
  response.base_held_out_rmse = result.base.held_out_rmse;
  response.base_fit_percent = result.base_fit_percent;
  response.noise_floor = result.noise_floor;
  response.structured_share = result.structured_share;
  response.surface_share = result.surface_share;
  for (const RankedModel& ranked : result.ranking) {
    response.ranked_effects.push_back(join(ranked.effects, " + "));
    response.ranked_held_out_rmse.push_back(ranked.held_out_rmse);
    response.ranked_error_removed_percent.push_back(ranked.error_removed_percent);
    response.ranked_significant.push_back(ranked.significant);
  }
  response.selected = result.selected;
  for (const std::vector<std::string>& group : result.indistinguishable)
    response.indistinguishable.push_back(join(group, ", "));
  response.suggested_drive = result.suggested_drive;
  if (result.extended && result.final_fit) addExtended(result, response);
  return response;
}

}  // namespace suspension_health_monitor
