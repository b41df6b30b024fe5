#include "suspension_health_monitor/internal/fit/output_error_fit.h"

#include <algorithm>
#include <cmath>

#include "output_error_problem.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

/// What a run from rest, the effects not acting yet, shows of the drives: rms values.
struct DriveSizes {
  MotionScale motion;
  std::vector<double> forces;  ///< of the effects, per unit of their coefficient
  ReadingSizes reading;  ///< of what is fitted only, the residual robust; of the body 0 where a channel is not known
};

/// @return nothing if the model runs away or there is nothing to fit.
std::optional<DriveSizes> measureSizes(const Segments& segments, const std::vector<SampleMask>& masks,
                                       const StrutModel& start) {
  StrutModel linear = start;  // the effects' memories run along
  for (ActiveEffect& active : linear.effects) active.coefficient = 0.0;
  FreeMotion motion;
  const auto residuals = freeRunResiduals(linear, segments, std::vector<StrutState>(segments.size()), &motion);
  if (!residuals) return std::nullopt;
  DriveSizes sizes;
  sizes.forces.resize(start.effects.size(), 0.0);
  double count = 0.0;
  std::vector<double> fitted;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const DriveSegment& segment = *segments[s];
    count += static_cast<double>(segment.size());
    for (std::size_t k = 0; k < segment.size(); ++k) {
      const StrutState& state = motion[s][k];
      sizes.motion.travel += square(state.travel);
      sizes.motion.travel_rate += square(state.travel_rate);
      for (std::size_t j = 0; j < start.effects.size(); ++j) {
        const auto& [effect, coefficient, shapes] = start.effects[j];
        const StrutMotion here{state.travel, state.travel_rate, segment.timeDriven(k), state.memory[j]};
        sizes.forces[j] += square(effect.force(here, shapes.data()));
      }
      if (!masks.empty() && masks[s][k] == 0) continue;
      sizes.reading.y += square(segment.sprung[k]);
      fitted.push_back((*residuals)[s][k]);
    }
  }
  if (fitted.empty()) return std::nullopt;
  sizes.motion = {std::sqrt(sizes.motion.travel / count), std::sqrt(sizes.motion.travel_rate / count),
                  1.0 / std::sqrt(start.stiffness_to_mass)};
  for (double& sum : sizes.forces) sum = std::sqrt(sum / count);
  const double y = std::sqrt(sizes.reading.y / static_cast<double>(fitted.size()));
  sizes.reading = {robustDeviation(std::move(fitted)), y, segments.front()->period, bodySizes(segments)};
  return sizes;
}

/// @return nothing if an effect never acts in these drives, or a fault of the measurement cannot show in them.
std::optional<std::vector<double>> coefficientScales(const StrutModel& start, const DriveSizes& sizes) {
  std::vector<double> scales;
  for (const double force : sizes.forces) {
    if (force == 0.0) return std::nullopt;
    scales.push_back(kSmall * sizes.reading.y / force);  // a coefficient of 1 makes a tenth of the acceleration
  }
  for (const ActiveMeasurementEffect& reading : start.reading) {
    bool shows = false;
    for (std::size_t i = 0; i < reading.coefficients.size(); ++i) {
      const double scale = reading.effect.scale(sizes.reading, i);
      shows = shows || std::isfinite(scale);
      scales.push_back(std::isfinite(scale) ? scale : 1.0);  // nothing moves the coefficient of a channel that is empty
    }
    if (!shows) return std::nullopt;
  }
  return scales;
}

/// A first guess of coefficients by linear thinking may make the model run away: they are halved until it does not.
/// @return false if that does not help.
bool tame(const Segments& segments, const std::vector<StrutState>& initial, StrutModel& model) {
  constexpr int most_halvings = 4;
  for (int halved = 0; !freeRunResiduals(model, segments, initial); ++halved) {
    if (halved == most_halvings) return false;
    for (ActiveEffect& active : model.effects) active.coefficient /= 2.0;
  }
  return true;
}

/// Adds initial states and residuals.
/// @param states  travel and travel rate that the segments begin with.
bool addResiduals(const Segments& segments, std::vector<StrutState> states, ModelFit& fit) {
  carryMemories(fit.model, segments, states);
  std::optional<Residuals> residuals = freeRunResiduals(fit.model, segments, states);
  if (!residuals) return false;
  fit.residuals = std::move(*residuals);
  fit.initial = std::move(states);
  return true;
}

template <class Value>
void cutEnds(std::size_t count, std::vector<Value>& values) {
  values.resize(values.size() - count);
  values.erase(values.begin(), values.begin() + count);
}

}  // namespace

bool runFree(const StrutModel& model, const DriveSegment& segment, StrutState state, std::vector<double>& predicted,
             std::vector<StrutState>* motion) {
  double largest = 0.0;
  for (const double y : segment.sprung) largest = std::max(largest, std::abs(y));
  const std::size_t lead = segment.lead(), count = segment.size() + 2 * lead;
  const double start = segment.timeDriven(0) - static_cast<double>(lead) * segment.period;
  const double step = segment.period / segment.steps;
  predicted.resize(count);
  if (motion != nullptr) motion->resize(count);
  auto wheel = segment.wheel.begin();
  for (std::size_t k = 0; k < count; ++k) {
    const double time = start + static_cast<double>(k) * segment.period;
    predicted[k] = model.force(state.travel, state.travel_rate, time, state.memory.data());
    if (!(std::abs(predicted[k]) <= kRunaway * largest)) return false;  // NaN, too
    if (motion != nullptr) (*motion)[k] = state;
    if (k + 1 == count) break;
    for (int s = 0; s < segment.steps; ++s) integrateStrut(model, time + s * step, step, *wheel++, state);
  }
  passLow(segment.taps, predicted);
  cutEnds(lead, predicted);
  if (motion != nullptr) cutEnds(lead, *motion);
  model.read(segment.body, segment.period, predicted);
  return true;
}

std::optional<Residuals> freeRunResiduals(const StrutModel& model, const Segments& segments,
                                          const std::vector<StrutState>& initial, FreeMotion* motion) {
  Residuals all;
  if (motion != nullptr) motion->resize(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::vector<double>& residuals = all.emplace_back();
    std::vector<StrutState>* const of_segment = motion != nullptr ? &(*motion)[s] : nullptr;
    if (!runFree(model, *segments[s], initial[s], residuals, of_segment)) return std::nullopt;
    for (std::size_t k = 0; k < residuals.size(); ++k) residuals[k] = segments[s]->sprung[k] - residuals[k];
  }
  return all;
}

FitOutcome fitOutputError(const Records& records, const std::vector<SampleMask>& masks, const StrutModel& guess,
                          const std::vector<StrutState>& guessed_states) {
  const Segments segments = segmentsOf(records);
  StrutModel start = guess;
  std::vector<StrutState> states = guessed_states;
  states.resize(segments.size());
  if (!(start.stiffness_to_mass > 0.0)) return FitFailure::kNoSpring;
  if (!tame(segments, states, start)) return FitFailure::kRunsAway;
  const std::optional<DriveSizes> sizes = measureSizes(segments, masks, start);
  if (!sizes) return FitFailure::kRunsAway;
  const auto coefficient_scales = coefficientScales(start, *sizes);
  if (!coefficient_scales) return FitFailure::kNeverActs;
  const Parameterization parameters(start, *coefficient_scales, sizes->motion);
  const double outlier = std::max(kOutlierScale * sizes->reading.residual, 1e-9 * sizes->reading.y);
  for (StrutState& state : states) state.memory = {};
  OutputErrorProblem problem(segments, masks, parameters, outlier, states);
  if (!problem.solve(false)) return FitFailure::kNotSolved;

  ModelFit fit{problem.model(), {}, {}, problem.standardDeviations(), sizes->motion};
  if (!(fit.model.stiffness_to_mass > 0.0)) return FitFailure::kNoSpring;
  if (!canFollow(fit.model, records.front()->period())) return FitFailure::kTooFast;
  if (!addResiduals(segments, problem.initial(), fit)) return FitFailure::kRunsAway;
  return fit;
}

std::optional<std::vector<StrutState>> estimateInitialStates(const Records& records, const StrutModel& model) {
  const FitOutcome at_rest = withoutFit(records, model);
  if (!at_rest) return std::nullopt;
  const double size = std::sqrt(meanSquare(at_rest->residuals)), rate = std::sqrt(model.stiffness_to_mass);
  if (size == 0.0) return at_rest->initial;
  const Parameterization parameters(model, std::vector<double>(numbersOf(model).size(), 1.0),
                                    {size / model.stiffness_to_mass, size / rate, 1.0 / rate});
  const Segments segments = segmentsOf(records);
  OutputErrorProblem problem(segments, {}, parameters, kOutlierScale * size, at_rest->initial);
  if (!problem.solve(true)) return std::nullopt;
  return problem.initial();
}

std::array<double, kNumBodyChannels> bodySizes(const Segments& segments) {
  std::array<double, kNumBodyChannels> sizes{};
  double count = 0.0;
  for (const DriveSegment* segment : segments) {
    count += static_cast<double>(segment->size());
    for (std::size_t c = 0; c < kNumBodyChannels; ++c)
      for (const double value : segment->body[c]) sizes[c] += square(value);
  }
  for (double& size : sizes) size = std::sqrt(size / count);
  return sizes;
}

double meanOf(const Residuals& residuals) {
  const Eigen::VectorXd all = joined(residuals);
  return all.size() > 0 ? all.mean() : 0.0;
}

double meanSquare(const Residuals& residuals) {
  const Eigen::VectorXd all = joined(residuals);
  return all.size() > 0 ? all.squaredNorm() / static_cast<double>(all.size()) : 0.0;
}

FitOutcome withoutFit(const Records& records, const StrutModel& model) {
  ModelFit fit;
  fit.model = model;
  const Segments segments = segmentsOf(records);
  if (!addResiduals(segments, std::vector<StrutState>(segments.size()), fit)) return FitFailure::kRunsAway;
  return fit;
}

}  // namespace suspension_health_monitor
