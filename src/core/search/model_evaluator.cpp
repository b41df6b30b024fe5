#include "model_evaluator.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <future>
#include <numeric>
#include <utility>

#include "rivals.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kFitted = 4;       // best candidates that are fitted in any case
constexpr double kPromising = 0.8;       // share of the best candidate's gain that is worth a fit, too
constexpr double kScreeningError = 1.2;  // by how much screening may overestimate a loss
constexpr double kScreeningTime = 0.4;   // of a round

/// Calls work(i) for i = 0 .. count - 1 on several threads, the calling one among them, and tick() on the calling
/// thread after each of its own items, with the share of all that these are. What tick() throws ends the work early and
/// passes on. work must not throw.
template <class Work, class Tick>
void forEachInParallel(std::size_t count, int threads, const Work& work, const Tick& tick) {
  std::atomic<std::size_t> next{0};
  const auto takeItems = [&](const auto& after) {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i);
      after();
    }
  };
  std::vector<std::future<void>> helpers;  // their end waits for the threads
  for (int i = 1; i < threads && static_cast<std::size_t>(i) < count; ++i)
    helpers.push_back(std::async(std::launch::async, [&] { takeItems([] {}); }));
  double done = 0.0;
  try {
    takeItems([&] { tick(++done / static_cast<double>(count)); });
  } catch (...) {
    next = count;
    throw;
  }
}

EvaluatedModel failed(const EvaluatedModel& before, FitFailure failure) {
  EvaluatedModel nothing = before;
  nothing.ranked.fitted = nothing.ranked.significant = false;
  nothing.ranked.failure = failure;
  nothing.ranked.error_removed_percent = nothing.ranked.significance = nothing.training_gain = 0.0;
  return nothing;
}

}  // namespace

std::size_t complexity(const StrutModel& model) { return numbersOf(model).size() - 2; }

ModelEvaluator::ModelEvaluator(const Records& records, const HoldOut& held_out, double outlier, std::size_t most_forces,
                               const DiagnoseOptions& options, const std::optional<StrutModel>& lagged)
    : records_(records),
      held_out_(held_out),
      outlier_(outlier),
      most_forces_(std::min(most_forces, kMostEffects)),
      options_(options),
      lagged_(lagged) {}

EvaluatedModel ModelEvaluator::weighed(const StrutModel& model, const Residuals& residuals) const {
  EvaluatedModel evaluated;
  evaluated.ranked.model = model;
  evaluated.ranked.effects = effectNames(model);
  evaluated.ranked.held_out_rmse = held_out_.rmse(residuals);
  // A model that was fitted can still run away in the stretches that were held out.
  if (!std::isfinite(evaluated.ranked.held_out_rmse)) evaluated.ranked.failure = FitFailure::kRunsAway;
  evaluated.stretches = held_out_.stretchLosses(residuals, outlier_);
  evaluated.independent = held_out_.independentSquares(residuals);
  evaluated.loss = std::accumulate(evaluated.stretches.begin(), evaluated.stretches.end(), 0.0);
  return evaluated;
}

void ModelEvaluator::rank(const EvaluatedModel& before, EvaluatedModel& evaluated) const {
  evaluated.ranked.error_removed_percent =
      100.0 * (1.0 - square(evaluated.ranked.held_out_rmse / before.ranked.held_out_rmse));
  evaluated.ranked.significance = before.gainOf(evaluated).t;
  evaluated.ranked.significant = evaluated.ranked.fitted && isWorthHaving(before, evaluated);
}

bool ModelEvaluator::isWorthHaving(const EvaluatedModel& before, const EvaluatedModel& after) const {
  const auto tests = static_cast<double>(options_.candidates.forces.size() + options_.candidates.readings.size());
  return before.loss - after.loss > kWorthHaving * after.to_explain &&
         isSignificant(before.gainOf(after), kFalseAlarm / tests);
}

// What the user's own model has is not questioned.
FitFailure ModelEvaluator::againstPhysics(const ModelFit& fit) const {
  const std::size_t given = options_.model ? options_.model->effects.size() : 0;
  for (std::size_t j = given; j < fit.model.effects.size(); ++j) {
    const ActiveEffect& active = fit.model.effects[j];
    if (active.effect.positive && !(active.coefficient > 0.0)) return FitFailure::kWrongSign;
    if (hasShapeAtEnd(active, fit.motion)) return FitFailure::kShapeAtEnd;
  }
  // A strut carries its body: an effect that makes the spring superfluous does something else's work.
  const bool is_spring = fit.model.stiffness_to_mass > normalQuantile(kFalseAlarm) * fit.stddev[1];
  if (fit.model.effects.size() > given && !is_spring) return FitFailure::kNoSpring;
  return FitFailure::kNone;
}

EvaluatedModel ModelEvaluator::evaluate(const StrutModel& start, const std::vector<StrutState>& initial,
                                        const EvaluatedModel* before) const {
  const FitOutcome fit = fitOutputError(records_, held_out_.training, start, initial);
  const FitFailure failure = fit ? againstPhysics(*fit) : fit.failure;
  const auto without = [&](FitFailure why) { return failed(before != nullptr ? *before : EvaluatedModel(), why); };
  if (failure != FitFailure::kNone) return without(failure);
  EvaluatedModel evaluated = asItIs(*fit);
  if (!evaluated.ranked.fitted) return without(evaluated.ranked.failure);
  if (before == nullptr) return evaluated;
  evaluated.to_explain = before->to_explain;
  rank(*before, evaluated);
  return evaluated;
}

EvaluatedModel ModelEvaluator::asItIs(const ModelFit& fit) const {
  EvaluatedModel evaluated = weighed(fit.model, fit.residuals);
  evaluated.fit = fit;
  evaluated.ranked.fitted = evaluated.ranked.failure == FitFailure::kNone;
  evaluated.to_explain = evaluated.loss;
  return evaluated;
}

EvaluatedModel ModelEvaluator::expected(const std::string& added, const ScreenedModel& screened,
                                        const EvaluatedModel& current) const {
  FitFailure failure = screened.failure;
  EvaluatedModel result;
  if (failure == FitFailure::kNone) {
    result = weighed(screened.model, screened.residuals);
    failure = result.ranked.failure;
  }
  if (failure == FitFailure::kNone) {
    result.training_gain = screened.training_gain;
    result.to_explain = current.to_explain;
    rank(current, result);
  } else {
    result = failed(current, failure);
    result.ranked.effects.push_back(added);
  }
  result.added = added;
  return result;
}

std::optional<EvaluatedModel> ModelEvaluator::screen(const ForceEffect& effect, const Screening& screening,
                                                     const RowStart& row_start, const EvaluatedModel& current) const {
  std::optional<ScreenedModel> screened = screening.screen(effect);
  if (!screened) return std::nullopt;
  // A law without a number inside is linear in all that is fitted: one start is as good as another.
  const auto start = effect.shapes.empty() ? std::nullopt : row_start.with(effect);
  std::optional<ScreenedModel> second = start ? screening.asItIs(start->model) : std::nullopt;
  const bool has_failed = screened->failure != FitFailure::kNone;
  if (second && (has_failed || second->training_gain > screened->training_gain)) std::swap(*screened, *second);
  EvaluatedModel result = expected(effect.name, *screened, current);
  if (!second) return result;
  if (!has_failed) result.second_start = second->model;
  const double to_gain = held_out_.trainingError(current.fit.residuals);
  result.training_gain = std::max(result.training_gain, start->share * to_gain);
  return result;
}

// A delay is linear only where it is short against the motion.
std::optional<EvaluatedModel> ModelEvaluator::screen(const MeasurementEffect& reading, const Screening& screening,
                                                     const EvaluatedModel& current) const {
  std::optional<ScreenedModel> screened = screening.screen(reading);
  if (lagged_ && lagged_->reading.front().effect.name == reading.name) {
    StrutModel model = current.fit.model;
    model.damping_to_mass = lagged_->damping_to_mass;
    model.stiffness_to_mass = lagged_->stiffness_to_mass;
    model.reading.push_back(lagged_->reading.front());
    std::optional<ScreenedModel> second = screening.asItIs(model);
    if (second && (!screened || second->training_gain > screened->training_gain)) screened.swap(second);
  }
  return screened ? std::optional(expected(reading.name, *screened, current)) : std::nullopt;
}

std::vector<EvaluatedModel> ModelEvaluator::screenAll(const EvaluatedModel& current, const Tick& tick) const {
  const Screening screening(records_, held_out_, current.fit);
  const RowStart row_start(records_, held_out_, current.fit);
  const std::vector<ForceEffect>& forces = options_.candidates.forces;
  const std::vector<MeasurementEffect>& readings = options_.candidates.readings;
  std::vector<std::optional<EvaluatedModel>> results(forces.size() + readings.size());
  const bool is_full = current.fit.model.effects.size() >= most_forces_;
  const auto isPresent = [&](const std::string& name) { return contains(current.ranked.effects, name); };
  const auto screenAt = [&](std::size_t i) {
    if (i < forces.size()) {
      if (!is_full && !isPresent(forces[i].name)) results[i] = screen(forces[i], screening, row_start, current);
    } else if (const MeasurementEffect& reading = readings[i - forces.size()]; !isPresent(reading.name)) {
      results[i] = screen(reading, screening, current);
    }
  };
  forEachInParallel(results.size(), options_.threads, screenAt, tick);
  std::vector<EvaluatedModel> ranking;
  for (std::optional<EvaluatedModel>& result : results)
    if (result) ranking.push_back(std::move(*result));
  std::sort(ranking.begin(), ranking.end(),
            [](const EvaluatedModel& a, const EvaluatedModel& b) { return a.training_gain > b.training_gain; });
  return ranking;
}

void ModelEvaluator::fitAll(const std::vector<std::size_t>& wanted, const EvaluatedModel& current,
                            std::vector<EvaluatedModel>& ranking, const Tick& tick) const {
  const auto fit = [&](std::size_t i) {
    EvaluatedModel& candidate = ranking[wanted[i]];
    EvaluatedModel fitted = evaluate(candidate.ranked.model, current.fit.initial, &current);
    if (!fitted.ranked.fitted && candidate.second_start)
      fitted = evaluate(*candidate.second_start, current.fit.initial, &current);
    fitted.added = candidate.added;
    if (isConfoundedWithFrequency(fitted, current)) fitted = failed(current, FitFailure::kConfoundedWithFrequency);
    if (wanders(fitted, current)) fitted = failed(current, FitFailure::kWanders);
    fitted.added = candidate.added;
    fitted.ranked.effects = candidate.ranked.effects;
    candidate = std::move(fitted);
  };
  forEachInParallel(wanted.size(), options_.threads, fit, tick);
}

bool ModelEvaluator::isConfoundedWithFrequency(const EvaluatedModel& candidate, const EvaluatedModel& current) const {
  const std::vector<ActiveEffect>& effects = candidate.ranked.model.effects;
  if (!candidate.ranked.significant || effects.empty() || effects.back().effect.name != candidate.added ||
      !changesSlowly(effects.back()))
    return false;
  const ForceEffect rival = frequencyRival(candidate.fit, records_, current.ranked.model.stiffness_to_mass);
  const std::optional<ScreenedModel> start = Screening(records_, held_out_, current.fit).screen(rival);
  if (!start) return false;
  const EvaluatedModel as_frequency = evaluate(start->model, current.fit.initial, &current);
  if (!as_frequency.ranked.fitted) return false;
  return !isWorthHaving(as_frequency, candidate);
}

bool ModelEvaluator::wanders(const EvaluatedModel& candidate, const EvaluatedModel& current) const {
  const StrutModel& model = candidate.ranked.model;
  if (!candidate.ranked.significant || model.reading.size() == current.ranked.model.reading.size()) return false;
  const double natural_period = 2.0 * M_PI / std::sqrt(model.stiffness_to_mass) / records_.front()->period();
  return isWanderingOffset(current.fit.residuals, candidate.fit.residuals, natural_period);
}

std::vector<EvaluatedModel> ModelEvaluator::rankAdditions(const EvaluatedModel& current, const Tick& tick) const {
  std::vector<EvaluatedModel> ranking = screenAll(current, [&](double share) { tick(kScreeningTime * share); });
  const double least_gain = kWorthHaving / 2.0 * held_out_.trainingError(current.fit.residuals);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < ranking.size(); ++i)
    if (!ranking[i].isTried() && (i < kFitted || ranking[i].training_gain > kPromising * ranking.front().training_gain))
      wanted.push_back(i);
  while (!wanted.empty()) {
    fitAll(wanted, current, ranking, [&](double share) { tick(kScreeningTime + (1.0 - kScreeningTime) * share); });
    // None that was only screened may look better than the best that was fitted.
    double limit = current.loss;
    for (const EvaluatedModel& candidate : ranking)
      if (candidate.ranked.fitted) limit = std::min(limit, kScreeningError * candidate.loss);
    wanted.clear();
    for (std::size_t i = 0; i < ranking.size(); ++i)
      if (!ranking[i].isTried() && ranking[i].training_gain > least_gain && ranking[i].loss < limit)
        wanted.push_back(i);
  }
  std::stable_sort(ranking.begin(), ranking.end(), [](const EvaluatedModel& a, const EvaluatedModel& b) {
    return a.ranked.fitted != b.ranked.fitted ? a.ranked.fitted : a.loss < b.loss;
  });
  return ranking;
}

EvaluatedModel ModelEvaluator::without(const EvaluatedModel& evaluated, const std::string& effect) const {
  StrutModel model = evaluated.ranked.model;
  const auto isIt = [&](const auto& active) { return active.effect.name == effect; };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), isIt), model.effects.end());
  model.reading.erase(std::remove_if(model.reading.begin(), model.reading.end(), isIt), model.reading.end());
  EvaluatedModel rest = evaluate(model, evaluated.fit.initial, nullptr);
  rest.to_explain = evaluated.to_explain;
  return rest;
}

}  // namespace suspension_health_monitor
