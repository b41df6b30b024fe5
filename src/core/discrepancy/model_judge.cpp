#include "model_judge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "parallel.h"

namespace suspension_health_monitor {
namespace {

constexpr double kFalseName = 0.001;     // chance of a false name, before correction for the number of candidates
constexpr double kWorthHaving = 0.02;    // of the mean square
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

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::size_t complexity(const StrutModel& model) {
  std::size_t count = 0;
  for (const ActiveMeasurementEffect& reading : model.reading) count += reading.coefficients.size();
  for (const ActiveEffect& active : model.effects) count += 1 + active.shapes.size();
  return count;
}

void ModelJudge::weigh(const std::vector<std::vector<double>>& residuals, Judged& judged) const {
  judged.ranked.held_out_rmse = held_out_.rmse(held_out_.stretchErrors(residuals));
  judged.stretches = held_out_.stretchLosses(residuals, outlier_);
  judged.independent = held_out_.independentSquares(residuals);
  judged.loss = std::accumulate(judged.stretches.begin(), judged.stretches.end(), 0.0);
}

void ModelJudge::rank(const Judged& before, Judged& judged) const {
  const PairedComparison gain = before.gainOf(judged);
  const double ratio = judged.ranked.held_out_rmse / before.ranked.held_out_rmse;
  judged.ranked.error_removed_percent = 100.0 * (1.0 - ratio * ratio);
  judged.ranked.significance = gain.t;
  judged.ranked.significant = judged.ranked.fitted && isWorthHaving(before, judged);
}

bool ModelJudge::isWorthHaving(const Judged& before, const Judged& after) const {
  const PairedComparison gain = before.gainOf(after);
  const auto tests = static_cast<double>(candidates_.forces.size() + candidates_.readings.size());
  return gain.removed_share > kWorthHaving && isSignificant(gain, kFalseName / tests);
}

std::optional<Judged> ModelJudge::judge(const StrutModel& start, const std::vector<StrutState>& initial,
                                        const Judged* before) const {
  FitOptions options;
  options.initial = initial;
  const std::optional<ModelFit> fit = fitOutputError(records_, held_out_.training, start, options);
  if (!fit) return std::nullopt;
  Judged judged;
  judged.fit = *fit;
  judged.ranked.model = fit->model;
  judged.ranked.effects = namesOf(fit->model);
  judged.ranked.fitted = true;
  weigh(fit->residuals, judged);
  if (before != nullptr) rank(*before, judged);
  return judged;
}

Judged ModelJudge::asScreened(const ScreenedModel& screened, const Judged& before) const {
  Judged judged;
  judged.ranked.model = screened.model;
  judged.ranked.effects = namesOf(screened.model);
  judged.training_gain = screened.training_gain;
  weigh(screened.residuals, judged);
  rank(before, judged);
  return judged;
}

std::vector<Judged> ModelJudge::screenAll(const Judged& current, const Tick& tick) const {
  const Screening screening(records_, held_out_, current.fit);
  const std::size_t num_forces = candidates_.forces.size(), count = num_forces + candidates_.readings.size();
  std::vector<std::optional<Judged>> results(count);
  const auto screen = [&](std::size_t i) {
    const bool is_force = i < num_forces;
    const std::string& name = is_force ? candidates_.forces[i].name : candidates_.readings[i - num_forces].name;
    if (has(current.ranked.effects, name)) return;
    if (is_force && current.fit.model.effects.size() >= most_forces_) return;
    const std::optional<ScreenedModel> screened =
        is_force ? screening.screen(candidates_.forces[i]) : screening.screen(candidates_.readings[i - num_forces]);
    if (!screened) return;
    results[i] = asScreened(*screened, current);
    results[i]->added = name;
  };
  double done = 0.0;
  forEachInParallel(count, threads_, screen, [&] { tick(++done / static_cast<double>(count)); });
  std::vector<Judged> ranking;
  for (std::optional<Judged>& result : results)
    if (result) ranking.push_back(std::move(*result));
  std::sort(ranking.begin(), ranking.end(),
            [](const Judged& a, const Judged& b) { return a.training_gain > b.training_gain; });
  return ranking;
}

void ModelJudge::fitAll(const std::vector<std::size_t>& wanted, const Judged& current, std::vector<Judged>& ranking,
                        const Tick& tick) const {
  double done = 0.0;
  forEachInParallel(
      wanted.size(), threads_,
      [&](std::size_t i) {
        Judged& candidate = ranking[wanted[i]];
        std::optional<Judged> judged = judge(candidate.ranked.model, current.fit.initial, &current);
        if (judged) {
          judged->added = candidate.added;
          candidate = std::move(*judged);
        }
        candidate.tried = true;
      },
      [&] { tick(++done / static_cast<double>(wanted.size())); });
}

std::vector<Judged> ModelJudge::rankAdditions(const Judged& current, const Tick& tick) const {
  std::vector<Judged> ranking = screenAll(current, [&](double share) { tick(kScreeningTime * share); });
  const double least_gain = kWorthHaving / 2.0 * held_out_.trainingError(current.fit.residuals);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < ranking.size(); ++i)
    if (i < kFitted || ranking[i].training_gain > kPromising * ranking.front().training_gain) wanted.push_back(i);
  while (!wanted.empty()) {
    fitAll(wanted, current, ranking, [&](double share) { tick(kScreeningTime + (1.0 - kScreeningTime) * share); });
    // None that was only screened may look better than the best that was fitted.
    double limit = current.loss;
    for (const Judged& judged : ranking)
      if (judged.ranked.fitted) limit = std::min(limit, kScreeningError * judged.loss);
    wanted.clear();
    for (std::size_t i = 0; i < ranking.size(); ++i)
      if (!ranking[i].tried && ranking[i].training_gain > least_gain && ranking[i].loss < limit) wanted.push_back(i);
  }
  const auto failed = [](const Judged& judged) { return judged.tried && !judged.ranked.fitted; };
  ranking.erase(std::remove_if(ranking.begin(), ranking.end(), failed), ranking.end());
  std::stable_sort(ranking.begin(), ranking.end(), [](const Judged& a, const Judged& b) {
    return a.ranked.fitted != b.ranked.fitted ? a.ranked.fitted : a.loss < b.loss;
  });
  return ranking;
}

std::optional<Judged> ModelJudge::without(const Judged& judged, const std::string& effect) const {
  StrutModel model = judged.ranked.model;
  const auto isIt = [&](const auto& active) { return active.effect.name == effect; };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), isIt), model.effects.end());
  model.reading.erase(std::remove_if(model.reading.begin(), model.reading.end(), isIt), model.reading.end());
  return judge(model, judged.fit.initial, nullptr);
}

}  // namespace suspension_health_monitor
