#include "suspension_health_monitor/discrepancy/comparison.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/discrepancy/held_out.h"
#include "suspension_health_monitor/discrepancy/initial_states.h"
#include "suspension_health_monitor/discrepancy/noise_floor.h"
#include "suspension_health_monitor/discrepancy/output_error_fit.h"
#include "suspension_health_monitor/identification/horizon_selection.h"

namespace suspension_health_monitor {
namespace {

using Records = std::vector<const DriveRecord*>;

/// Fits the model, or keeps it; the free runs over all segments.
bool runModel(const Records& records, const ComparisonOptions& options, Comparison& comparison) {
  std::vector<StrutState> initial;
  if (options.fit) {
    std::optional<ModelFit> fit = fitOutputError(records, {}, comparison.model);
    if (!fit) return false;
    comparison.model = fit->model;
    comparison.stddev = fit->stddev;
    initial = std::move(fit->initial);
  } else {
    std::optional<std::vector<StrutState>> states = estimateInitialStates(records, comparison.model);
    if (!states) return false;
    initial = std::move(*states);
  }
  std::optional<std::vector<ComparedSegment>> segments = compareSegments(records, comparison.model, initial);
  if (!segments) return false;
  comparison.segments = std::move(*segments);
  return true;
}

std::vector<std::vector<double>> residualsOf(const std::vector<ComparedSegment>& segments) {
  std::vector<std::vector<double>> residuals;
  for (const ComparedSegment& segment : segments) {
    residuals.emplace_back();
    for (std::size_t k = 0; k < segment.size(); ++k) residuals.back().push_back(segment.residual(k));
  }
  return residuals;
}

std::optional<double> heldOutRmse(const Records& records, const ComparisonOptions& options,
                                  const Comparison& comparison) {
  const std::optional<HeldOut> held_out = holdOut(records, comparison.model.stiffness_to_mass);
  if (!held_out) return std::nullopt;
  if (!options.fit) return held_out->rmse(held_out->stretchErrors(residualsOf(comparison.segments)));
  const std::optional<ModelFit> fit = fitOutputError(records, held_out->training, comparison.model);
  if (!fit) return std::nullopt;
  return held_out->rmse(held_out->stretchErrors(fit->residuals));
}

int horizonFor(const ComparisonOptions& options, const StrutModel& model, double period) {
  if (options.horizon_samples) return *options.horizon_samples;
  const double horizon = proposeHorizon(model.damping_to_mass, model.stiffness_to_mass).horizon;
  return horizonSamples(horizon, period, IntegralFilterOptions{}.rule);
}

bool isStable(const StrutModel& model) { return model.damping_to_mass > 0.0 && model.stiffness_to_mass > 0.0; }

}  // namespace

std::optional<Comparison> compareModel(const std::vector<const DriveRecord*>& records, const StrutModel& model,
                                       const ComparisonOptions& options,
                                       const std::function<void(double share)>& progress) {
  const auto report = [&](double share) {
    if (progress) progress(share);
  };
  std::size_t num_samples = 0;
  for (const DriveRecord* record : records) num_samples += record->numSamples();
  if (num_samples == 0 || !isStable(model)) return std::nullopt;
  Comparison comparison;
  comparison.model = model;
  if (!runModel(records, options, comparison) || !isStable(comparison.model)) return std::nullopt;
  const std::optional<PredictionError> free_run = freeRunError(comparison.segments);
  if (!free_run) return std::nullopt;
  comparison.free_run = *free_run;
  report(0.4);
  comparison.held_out_rmse = heldOutRmse(records, options, comparison);
  report(0.7);

  IntegralFilterOptions filter;
  filter.period = records.front()->period();
  filter.horizon_samples = comparison.horizon_samples = horizonFor(options, comparison.model, filter.period);
  comparison.one_step = oneStepError(comparison.segments, comparison.model, filter);
  // Noise cannot leave more than this very model does.
  comparison.noise_floor = std::min(estimateNoiseFloor(records, comparison.model), comparison.free_run.rmse);
  if (!(comparison.noise_floor > 0.0)) return std::nullopt;
  comparison.structured_share = std::max(0.0, 1.0 - std::pow(comparison.noise_floor / comparison.free_run.rmse, 2));
  report(0.85);
  const ExpectedNoise noise{comparison.noise_floor, comparison.model.damping_to_mass,
                            comparison.model.stiffness_to_mass};
  std::optional<ResidualViews> views = viewResidual(comparison.segments, noise);
  if (!views) return std::nullopt;
  comparison.views = std::move(*views);
  comparison.where = whereItFails(comparison.views, noise);
  report(1.0);
  return comparison;
}

}  // namespace suspension_health_monitor
