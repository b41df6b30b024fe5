#include "suspension_health_monitor/internal/compare/comparison.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/fit/free_form.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/identification/regression.h"
#include "suspension_health_monitor/internal/search/screening.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

/// @param taps  of the filter that the drive has passed.
void addMissingForce(const StrutModel& model, const std::vector<StrutState>& motion, double mean,
                     const std::vector<double>& taps, ComparedSegment& segment) {
  const MotionError wrong = motionError(segment.residuals(), mean, segment.period, model.stiffness_to_mass);
  std::vector<double>& force = segment.missing_force;
  force.resize(segment.size());
  for (std::size_t k = 0; k < segment.size(); ++k)
    force[k] = model.force(segment.travel[k] - wrong.travel[k], segment.travel_rate[k] - wrong.travel_rate[k],
                           segment.timeDriven(k), motion[k].memory.data());
  passLow(taps, force);
  model.read(segment.body, segment.period, force);
  for (std::size_t k = 0; k < segment.size(); ++k) force[k] = segment.measured[k] - force[k];
}

ComparedSegment makeSegment(const StrutModel& model, const DriveSegment& source,
                            const std::vector<StrutState>& motion) {
  ComparedSegment segment;
  segment.start = source.start;
  segment.driven_before = source.driven_before;
  segment.period = source.period;
  segment.measured = source.sprung;
  segment.wheel = source.unsprung;
  segment.body = source.body;
  for (std::size_t k = 0; k < source.size(); ++k) {
    const StrutState& state = motion[k];
    segment.travel.push_back(state.travel);
    segment.travel_rate.push_back(state.travel_rate);
    segment.added_force.push_back(
        model.force(state.travel, state.travel_rate, segment.timeDriven(k), state.memory.data()) -
        model.damping_to_mass * state.travel_rate - model.stiffness_to_mass * state.travel);
  }
  passLow(source.taps, segment.added_force);
  return segment;
}

/// @return nothing if the measurement does not move, or there is none.
std::optional<PredictionError> errorOf(const Residuals& measurement, const Residuals& prediction) {
  const Eigen::VectorXd measured = joined(measurement), predicted = joined(prediction);
  if (measured.size() == 0) return std::nullopt;
  const double error = (measured - predicted).squaredNorm();
  const double spread = (measured.array() - measured.mean()).square().sum();
  if (!(spread > 0.0) || !std::isfinite(error)) return std::nullopt;
  const auto count = static_cast<double>(measured.size());
  return PredictionError{std::sqrt(error / count), 100.0 * (1.0 - std::sqrt(error / spread))};
}

/// The measurement without the faults of its reading, to first order in them.
std::vector<double> trueReading(const ComparedSegment& segment, const StrutModel& model) {
  std::vector<double> faulty = segment.measured;
  model.read(segment.body, segment.period, faulty);
  for (std::size_t k = 0; k < faulty.size(); ++k) faulty[k] = 2.0 * segment.measured[k] - faulty[k];
  return faulty;
}

/// Error of the regression rows with the model's numbers,
///   I_2^2 y = b1 I_1^2 u + b0 I_0^2 u + sum_j c_j I_2^2 f_j,   u = w'' - y,
/// f_j from the free run's travel and rate: what the live estimators see of the model. A fault of the reading is taken
/// out of y to first order.
/// @param filter  its period is that of the segments.
/// @return nothing if no segment is longer than the filter.
std::optional<PredictionError> oneStepError(const std::vector<ComparedSegment>& segments, const StrutModel& model,
                                            const IntegralFilterOptions& filter) {
  std::vector<double> measured, predicted;
  for (const ComparedSegment& segment : segments) {
    SuspensionRegression regression(filter);
    LinearIntegralFilter added(2, filter, 2);
    const std::vector<double> reading = trueReading(segment, model);
    for (std::size_t k = 0; k < segment.size(); ++k) {
      added.push(segment.added_force[k]);
      const RegressionRow* row = regression.push({{}, reading[k], segment.wheel[k]});
      if (row == nullptr) continue;
      measured.push_back(row->output);
      predicted.push_back(model.damping_to_mass * row->regressor[kDampingToMass] +
                          model.stiffness_to_mass * row->regressor[kStiffnessToMass] + added.output(2));
    }
  }
  return errorOf({measured}, {predicted});
}

/// Fits the model, or keeps it.
/// @return the state in which every segment begins; nothing if the model runs away or no spring is left.
std::optional<std::vector<StrutState>> settleModel(const Records& records, const CompareOptions& options,
                                                   Comparison& comparison) {
  if (!options.fit) return estimateInitialStates(records, comparison.model);
  FitOutcome fit = fitOutputError(records, {}, comparison.model);
  if (!fit || !fit->model.isDampedSpring()) return std::nullopt;
  comparison.model = fit->model;
  comparison.stddev = fit->stddev;
  return std::move(fit->initial);
}

/// The model as it does on what was held out: fitted on the rest, or as it is.
std::optional<ModelFit> judgedFit(const Records& records, const HoldOut& held_out, const CompareOptions& options,
                                  const std::vector<StrutState>& initial, const Comparison& comparison) {
  if (!options.fit)
    return ModelFit{comparison.model, initial, mapped(comparison.segments, &ComparedSegment::residuals), {}, {}};
  return fitOutputError(records, held_out.training, comparison.model);
}

/// [from, to] of what is held out, per drive.
std::vector<std::vector<std::pair<double, double>>> heldOutSpans(const Records& records, const HoldOut& held_out) {
  std::vector<std::vector<std::pair<double, double>>> spans;
  auto mask = held_out.training.begin();
  for (const DriveRecord* record : records) {
    auto& of_drive = spans.emplace_back();
    for (const DriveSegment& segment : record->segments()) {
      const SampleMask& fitted = *mask++;
      for (std::size_t k = 0; k < segment.size(); ++k) {
        if (fitted[k] != 0) continue;
        if (k == 0 || fitted[k - 1] != 0) of_drive.emplace_back(segment.time(k), 0.0);
        of_drive.back().second = segment.time(k);
      }
    }
  }
  return spans;
}

int horizonFor(const CompareOptions& options, const LinearStrut& strut, double period) {
  if (options.horizon_samples) return *options.horizon_samples;
  return horizonSamples(proposeHorizon(strut.damping_to_mass, strut.stiffness_to_mass), period);
}

/// @return what is the matter, if anything.
Shortcoming fill(const Records& records, const CompareOptions& options, Comparison& comparison) {
  const auto report = [&](double share) {
    if (options.progress) options.progress(share);
  };
  if (segmentsOf(records).empty()) return Shortcoming::kTooShort;
  if (!comparison.model.isDampedSpring()) return Shortcoming::kNoDampedSpring;
  const std::optional<std::vector<StrutState>> initial = settleModel(records, options, comparison);
  if (!initial) return Shortcoming::kNoStableFit;
  std::optional<ComparedDrives> compared = compareSegments(records, comparison.model, *initial);
  if (!compared) return Shortcoming::kNoStableFit;
  comparison.segments = std::move(compared->segments);
  const auto free_run = errorOf(mapped(comparison.segments, &ComparedSegment::measured),
                                mapped(comparison.segments, &ComparedSegment::predicted));
  if (!free_run) return Shortcoming::kTooShort;
  if (options.fit && free_run->fit_percent < 0.0) return Shortcoming::kNoStableFit;  // worse than a constant
  comparison.free_run = *free_run;
  report(0.4);
  // What a free-form law of travel and travel rate, fitted to the rest, would take of the mean square that was held
  // out, and the rms that it leaves, which is above the noise floor.
  double by_law = 0.0, law_leaves = 0.0;
  if (const auto held_out = splitHoldOut(records, comparison.model.stiffness_to_mass)) {
    if (const auto fit = judgedFit(records, *held_out, options, *initial, comparison)) {
      comparison.held_out_rmse = held_out->rmse(fit->residuals);
      by_law = Screening(records, *held_out, *fit).surfaceGain();
      law_leaves = *comparison.held_out_rmse * std::sqrt(1.0 - by_law);
    }
    comparison.held_out = heldOutSpans(records, *held_out);
  }
  report(0.7);

  IntegralFilterOptions filter;
  filter.period = records.front()->period();
  const LinearStrut strut = comparison.model.linearPart();
  filter.horizon_samples = comparison.horizon_samples = horizonFor(options, strut, filter.period);
  comparison.one_step = oneStepError(comparison.segments, comparison.model, filter);
  comparison.noise_floor = estimateNoiseFloor(records, comparison.model);
  if (!(comparison.noise_floor > 0.0)) return Shortcoming::kTooShort;
  // What a law of travel and travel rate takes is no noise, whatever its spectrum.
  NoiseFloor floor{std::min(comparison.noise_floor, law_leaves)};
  if (by_law < kStructured)
    floor = floorOfResidual(comparison.free_run.rmse, comparison.noise_floor,
                            mapped(comparison.segments, &ComparedSegment::residuals),
                            mapped(comparison.segments, &ComparedSegment::wheel), filter.period, comparison.model);
  comparison.noise_floor = floor.rms;
  comparison.structured_share = structuredShare(comparison.free_run.rmse, comparison.noise_floor);
  report(0.85);
  std::optional<ResidualViews> views = viewResidual(comparison.segments, strut, floor);
  if (!views) return Shortcoming::kTooShort;
  comparison.views = std::move(*views);
  comparison.where = findFailures(comparison.views, strut, comparison.noise_floor);
  comparison.forces = partialResiduals(comparison.segments, compared->motion, comparison.model);
  report(1.0);
  return Shortcoming::kNone;
}

}  // namespace

std::vector<double> ComparedSegment::residuals() const {
  std::vector<double> all(size());
  for (std::size_t k = 0; k < size(); ++k) all[k] = residual(k);
  return all;
}

std::optional<ComparedDrives> compareSegments(const Records& records, const StrutModel& model,
                                              const std::vector<StrutState>& initial) {
  ComparedDrives compared;
  auto& [segments, motion] = compared;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (const DriveSegment& source : records[r]->segments()) {
      std::vector<double> predicted;
      motion.emplace_back();
      if (!runFree(model, source, initial[segments.size()], predicted, &motion.back())) return std::nullopt;
      segments.push_back(makeSegment(model, source, motion.back()));
      segments.back().drive = r;
      segments.back().predicted = std::move(predicted);
    }
  const double mean = meanOf(mapped(segments, &ComparedSegment::residuals));
  const Segments sources = segmentsOf(records);
  for (std::size_t i = 0; i < segments.size(); ++i)
    addMissingForce(model, motion[i], mean, sources[i]->taps, segments[i]);
  return compared;
}

Comparison compareModel(const Records& records, const StrutModel& model, const CompareOptions& options) {
  Comparison comparison;
  comparison.model = model;
  const Shortcoming shortcoming = fill(records, options, comparison);
  if (shortcoming == Shortcoming::kNone) return comparison;
  Comparison nothing;
  nothing.model = model;
  nothing.shortcoming = shortcoming;
  return nothing;
}

}  // namespace suspension_health_monitor
