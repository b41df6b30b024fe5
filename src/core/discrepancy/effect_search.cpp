#include "suspension_health_monitor/discrepancy/effect_search.h"

#include <algorithm>
#include <cmath>

#include "median.h"
#include "model_judge.h"
#include "separating_drive.h"
#include "suspension_health_monitor/discrepancy/noise_floor.h"
#include "suspension_health_monitor/discrepancy/sampling_limit.h"

namespace suspension_health_monitor {
namespace {

constexpr double kStructured = 0.2;                // of a mean square; below it, what is left counts as noise
constexpr double kExplained = 0.5;                 // of the structure, or there is no name
constexpr double kTakenByAnother = 0.3;            // of what is left
constexpr double kIndistinguishable = 0.02;        // of the mean square, or not significant
constexpr double kStarted = 0.1, kForward = 0.85;  // of the progress

double square(double x) { return x * x; }

/// What is in a model and was not in the one that the search started with.
std::vector<std::string> namesBeyond(const Judged& base, const Judged& judged) {
  std::vector<std::string> added;
  for (const std::string& name : judged.ranked.effects)
    if (std::find(base.ranked.effects.begin(), base.ranked.effects.end(), name) == base.ranked.effects.end())
      added.push_back(name);
  return added;
}

/// The residual from which on a fit counts outliers.
double outlierOf(const ModelFit& fit) {
  std::vector<double> absolute;
  for (const std::vector<double>& segment : fit.residuals)
    for (const double r : segment) absolute.push_back(std::abs(r));
  const double size = median(std::move(absolute));
  return size > 0.0 ? FitOptions{}.outlier_scale * kSigmaPerMedian * size : 1.0;
}

std::vector<RankedModel> asReported(const std::vector<Judged>& ranking) {
  std::vector<RankedModel> models;
  for (const Judged& judged : ranking) models.push_back(judged.ranked);
  std::stable_sort(models.begin(), models.end(),
                   [](const RankedModel& a, const RankedModel& b) { return a.held_out_rmse < b.held_out_rmse; });
  return models;
}

class Search {
 public:
  Search(const EffectLibrary& candidates, const SearchOptions& options, const std::vector<const DriveRecord*>& records,
         const EffectSearch::Progress& progress)
      : candidates_(candidates), options_(options), records_(records), progress_(progress) {}

  std::optional<SearchResult> run(const StrutModel& start);

 private:
  void report(double share) const {
    if (progress_) progress_(share);
  }
  /// The best of a ranking, or the simplest that is as good, and all that are as good.
  struct Selection {
    Judged chosen;
    std::vector<std::string> group;
    std::vector<StrutModel> models;  // of the group
  };

  static Selection select(const std::vector<Judged>& ranking);
  static void noteGroup(const ModelJudge& judge, const Selection& selection, SearchResult& result);
  Judged extend(const ModelJudge& judge, const Judged& base, SearchResult& result) const;
  Judged refine(const ModelJudge& judge, const Judged& base, Judged current, SearchResult& result) const;
  static Judged withoutSuperfluous(const ModelJudge& judge, const Judged& base, Judged current);
  static Judged reconsidered(const ModelJudge& judge, Judged current, const std::vector<std::string>& added,
                             const ModelJudge::Tick& tick, SearchResult& result);
  static bool isExplained(const ModelJudge& judge, const Judged& before, const Judged& after, double noise_floor);
  void conclude(const ModelJudge& judge, const Judged& base, const Judged& last, SearchResult& result) const;

  const EffectLibrary& candidates_;
  const SearchOptions& options_;
  const std::vector<const DriveRecord*>& records_;
  const EffectSearch::Progress& progress_;
};

// @pre the first of the ranking is fitted.
Search::Selection Search::select(const std::vector<Judged>& ranking) {
  const Judged& best = ranking.front();
  Selection selection{best, {}, {}};
  for (const Judged& rival : ranking) {
    if (!rival.ranked.fitted) continue;
    const PairedComparison loss = rival.gainOf(best);
    if (loss.removed_share > kIndistinguishable || isSignificant(loss, 0.01)) continue;
    selection.group.push_back(rival.added);
    selection.models.push_back(rival.ranked.model);
    if (complexity(rival.ranked.model) < complexity(selection.chosen.ranked.model)) selection.chosen = rival;
  }
  return selection;
}

void Search::noteGroup(const ModelJudge& judge, const Selection& selection, SearchResult& result) {
  if (selection.group.size() < 2) return;
  result.indistinguishable.push_back(selection.group);
  result.suggested_drive += (result.suggested_drive.empty() ? "" : " ") +
                            suggestSeparatingDrive(judge.motionOf(selection.chosen), selection.group, selection.models);
}

// What the first effect explained, the later ones may explain better together.
Judged Search::withoutSuperfluous(const ModelJudge& judge, const Judged& base, Judged current) {
  const std::string newest = current.added;
  for (const std::string& name : namesBeyond(base, current)) {
    if (name == newest) continue;
    const std::optional<Judged> without = judge.without(current, name);
    if (without && !judge.isWorthHaving(*without, current)) current = *without;
  }
  return current;
}

// Each effect was chosen before the later ones were known: is it still the one, and with which others is it confused?
Judged Search::reconsidered(const ModelJudge& judge, Judged current, const std::vector<std::string>& added,
                            const ModelJudge::Tick& tick, SearchResult& result) {
  for (const std::string& name : added) {
    const std::optional<Judged> without = judge.without(current, name);
    if (!without) continue;
    const std::vector<Judged> ranking = judge.rankAdditions(*without, tick);
    if (ranking.empty() || !ranking.front().ranked.fitted) continue;
    const Selection selection = select(ranking);
    noteGroup(judge, selection, result);
    if (std::find(selection.group.begin(), selection.group.end(), name) == selection.group.end() ||
        complexity(selection.chosen.ranked.model) < complexity(current.ranked.model))
      current = selection.chosen;
  }
  return current;
}

// Forward selection: the best addition as long as it pays.
Judged Search::extend(const ModelJudge& judge, const Judged& base, SearchResult& result) const {
  Judged current = base;
  for (int round = 0; round < options_.most_effects; ++round) {
    const double done = kStarted + kForward * round / options_.most_effects;
    const auto tick = [&](double share) { report(done + kForward * share / options_.most_effects); };
    const std::vector<Judged> ranking = judge.rankAdditions(current, tick);
    if (round == 0) result.ranking = asReported(ranking);
    if (ranking.empty()) break;
    // Whatever a free run leaves of data that it was not fitted to is above the floor.
    result.noise_floor = std::min(result.noise_floor, ranking.front().ranked.held_out_rmse);
    if (!ranking.front().ranked.significant) break;
    const Selection selection = select(ranking);
    if (round == 0) noteGroup(judge, selection, result);
    current = withoutSuperfluous(judge, base, selection.chosen);
  }
  return current;
}

// Of several effects every one again. That may make one superfluous, which changes what the others are confused with.
Judged Search::refine(const ModelJudge& judge, const Judged& base, Judged current, SearchResult& result) const {
  for (bool changed = namesBeyond(base, current).size() > 1; changed;) {
    result.indistinguishable.clear();
    result.suggested_drive.clear();
    const auto tick = [this](double) { report(kStarted + kForward); };
    current = reconsidered(judge, current, namesBeyond(base, current), tick, result);
    const std::size_t before = current.ranked.effects.size();
    current.added.clear();  // none is too new to go
    current = withoutSuperfluous(judge, base, current);
    changed = current.ranked.effects.size() < before;
  }
  return current;
}

std::optional<SearchResult> Search::run(const StrutModel& start) {
  const std::optional<ModelFit> rough = fitOutputError(records_, {}, start);
  if (!rough) return std::nullopt;
  const std::optional<HeldOut> held_out = holdOut(records_, rough->model.stiffness_to_mass);
  if (!held_out) return std::nullopt;
  const std::size_t most_forces = start.effects.size() + static_cast<std::size_t>(options_.most_forces);
  const ModelJudge judge(records_, *held_out, outlierOf(*rough), candidates_, most_forces, options_.threads);
  const std::optional<Judged> base = judge.judge(rough->model, rough->initial, nullptr);
  if (!base) return std::nullopt;
  report(kStarted);

  SearchResult result;
  result.base = base->ranked;
  result.base_fit_percent = held_out->fitPercent(base->ranked.held_out_rmse);
  result.noise_floor = estimateNoiseFloor(records_, base->ranked.model);
  const Judged last = refine(judge, *base, extend(judge, *base, result), result);
  result.noise_floor = std::min(result.noise_floor, last.ranked.held_out_rmse);
  conclude(judge, *base, last, result);
  report(1.0);
  return result;
}

// A name is given if the model with it leaves noise only; or if it takes most of the structure and no other law of
// travel and travel rate would take the rest: that comes from elsewhere, or was lost in sampling.
bool Search::isExplained(const ModelJudge& judge, const Judged& before, const Judged& after, double noise_floor) {
  const double structure = square(before.ranked.held_out_rmse) - square(noise_floor);
  const double left = square(after.ranked.held_out_rmse) - square(noise_floor);
  if (left > (1.0 - kExplained) * structure) return false;
  return left < kStructured * square(after.ranked.held_out_rmse) ||
         judge.surfaceGain(after) * square(after.ranked.held_out_rmse) < kTakenByAnother * left;
}

void Search::conclude(const ModelJudge& judge, const Judged& base, const Judged& last, SearchResult& result) const {
  const double before = square(base.ranked.held_out_rmse);
  const double structure = before - square(result.noise_floor);
  result.structured_share = std::clamp(structure / before, 0.0, 1.0);
  if (structure > 0.0) result.surface_share = std::min(1.0, judge.surfaceGain(base) * before / structure);
  const std::vector<std::string> added = namesBeyond(base, last);
  if (!added.empty() && isExplained(judge, base, last, result.noise_floor)) {
    result.verdict = Verdict::kEffectFound;
    result.selected = added;
    result.extended = last.ranked;
    result.extended_fit_percent = judge.heldOut().fitPercent(last.ranked.held_out_rmse);
    FitOptions fit;
    fit.initial = last.fit.initial;
    result.final_fit = fitOutputError(records_, {}, last.ranked.model, fit);
    return;
  }
  result.indistinguishable.clear();
  result.suggested_drive.clear();
  result.verdict =
      !added.empty() || result.structured_share > kStructured ? Verdict::kUnexplained : Verdict::kNothingMissing;
  if (result.verdict == Verdict::kUnexplained)
    result.suggested_drive = suggestDriveForUnexplained(result.surface_share, powerAtSamplingLimit(records_));
}

}  // namespace

EffectSearch::EffectSearch(EffectLibrary candidates, const SearchOptions& options)
    : candidates_(std::move(candidates)), options_(options) {}

std::optional<SearchResult> EffectSearch::run(const std::vector<const DriveRecord*>& records, const StrutModel& start,
                                              const Progress& progress) const {
  return Search(candidates_, options_, records, progress).run(start);
}

}  // namespace suspension_health_monitor
