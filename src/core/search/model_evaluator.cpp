#include "model_evaluator.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "parallel.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kFitted = 4;       // best candidates that are fitted in any case
constexpr double kPromising = 0.8;       // share of the best candidate's gain that is worth a fit, too
constexpr double kScreeningError = 1.2;  // by how much screening may overestimate a loss
constexpr double kScreeningTime = 0.4;   // of a round

std::vector<std::string> namesOf(const StrutModel& model) {
  std::vector<std::string> names;
  for (const ActiveEffect& active : model.effects) names.push_back(active.effect.name);
  for (const ActiveMeasurementEffect& reading : model.reading) names.push_back(reading.effect.name);
  return names;
}

}  // namespace

std::size_t complexity(const StrutModel& model) { return numbersOf(model).size() - 2; }

ModelEvaluator::ModelEvaluator(const Records& records, const HoldOut& held_out, double outlier, std::size_t most_forces,
                               const DiagnoseOptions& options)
    : records_(records),
      held_out_(held_out),
      outlier_(outlier),
      most_forces_(std::min(most_forces, kMostEffects)),
      options_(options) {}

EvaluatedModel ModelEvaluator::weighed(const StrutModel& model, const Residuals& residuals) const {
  EvaluatedModel evaluated;
  evaluated.ranked.model = model;
  evaluated.ranked.effects = namesOf(model);
  evaluated.ranked.held_out_rmse = held_out_.rmse(held_out_.stretchErrors(residuals));
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
  const PairedTest gain = before.gainOf(after);
  const auto tests = static_cast<double>(options_.candidates.forces.size() + options_.candidates.readings.size());
  return gain.removed_share > kWorthHaving && isSignificant(gain, kFalseAlarm / tests);
}

std::optional<EvaluatedModel> ModelEvaluator::evaluate(const StrutModel& start, const std::vector<StrutState>& initial,
                                                       const EvaluatedModel* before) const {
  FitOptions options;
  options.initial = initial;
  const std::optional<ModelFit> fit = fitOutputError(records_, held_out_.training, start, options);
  if (!fit) return std::nullopt;
  EvaluatedModel evaluated = weighed(fit->model, fit->residuals);
  evaluated.fit = *fit;
  evaluated.ranked.fitted = true;
  if (before != nullptr) rank(*before, evaluated);
  return evaluated;
}

std::vector<EvaluatedModel> ModelEvaluator::screenAll(const EvaluatedModel& current, const Tick& tick) const {
  const Screening screening(records_, held_out_, current.fit);
  const std::vector<ForceEffect>& forces = options_.candidates.forces;
  const std::vector<MeasurementEffect>& readings = options_.candidates.readings;
  const std::size_t count = forces.size() + readings.size();
  std::vector<std::optional<EvaluatedModel>> results(count);
  const auto screen = [&](std::size_t i, const auto& effect) {
    const std::vector<std::string>& present = current.ranked.effects;
    if (std::find(present.begin(), present.end(), effect.name) != present.end()) return;
    const std::optional<ScreenedModel> screened = screening.screen(effect);
    if (!screened) return;
    results[i] = weighed(screened->model, screened->residuals);
    results[i]->training_gain = screened->training_gain;
    results[i]->added = effect.name;
    rank(current, *results[i]);
  };
  const bool full = current.fit.model.effects.size() >= most_forces_;
  const auto screenAt = [&](std::size_t i) {
    if (i >= forces.size())
      screen(i, readings[i - forces.size()]);
    else if (!full)
      screen(i, forces[i]);
  };
  double done = 0.0;
  forEachInParallel(count, options_.threads, screenAt, [&] { tick(++done / static_cast<double>(count)); });
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
    std::optional<EvaluatedModel> fitted = evaluate(candidate.ranked.model, current.fit.initial, &current);
    if (fitted) {
      fitted->added = candidate.added;
      candidate = std::move(*fitted);
    }
    candidate.tried = true;
  };
  double done = 0.0;
  forEachInParallel(wanted.size(), options_.threads, fit, [&] { tick(++done / static_cast<double>(wanted.size())); });
}

std::vector<EvaluatedModel> ModelEvaluator::rankAdditions(const EvaluatedModel& current, const Tick& tick) const {
  std::vector<EvaluatedModel> ranking = screenAll(current, [&](double share) { tick(kScreeningTime * share); });
  const double least_gain = kWorthHaving / 2.0 * held_out_.trainingError(current.fit.residuals);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < ranking.size(); ++i)
    if (i < kFitted || ranking[i].training_gain > kPromising * ranking.front().training_gain) wanted.push_back(i);
  while (!wanted.empty()) {
    fitAll(wanted, current, ranking, [&](double share) { tick(kScreeningTime + (1.0 - kScreeningTime) * share); });
    // None that was only screened may look better than the best that was fitted.
    double limit = current.loss;
    for (const EvaluatedModel& candidate : ranking)
      if (candidate.ranked.fitted) limit = std::min(limit, kScreeningError * candidate.loss);
    wanted.clear();
    for (std::size_t i = 0; i < ranking.size(); ++i)
      if (!ranking[i].tried && ranking[i].training_gain > least_gain && ranking[i].loss < limit) wanted.push_back(i);
  }
  const auto failed = [](const EvaluatedModel& candidate) { return candidate.tried && !candidate.ranked.fitted; };
  ranking.erase(std::remove_if(ranking.begin(), ranking.end(), failed), ranking.end());
  std::stable_sort(ranking.begin(), ranking.end(), [](const EvaluatedModel& a, const EvaluatedModel& b) {
    return a.ranked.fitted != b.ranked.fitted ? a.ranked.fitted : a.loss < b.loss;
  });
  return ranking;
}

std::optional<EvaluatedModel> ModelEvaluator::without(const EvaluatedModel& evaluated,
                                                      const std::string& effect) const {
  StrutModel model = evaluated.ranked.model;
  const auto isIt = [&](const auto& active) { return active.effect.name == effect; };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), isIt), model.effects.end());
  model.reading.erase(std::remove_if(model.reading.begin(), model.reading.end(), isIt), model.reading.end());
  return evaluate(model, evaluated.fit.initial, nullptr);
}

}  // namespace suspension_health_monitor
