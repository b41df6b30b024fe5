#include "suspension_health_monitor/internal/search/effect_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "explanation.h"
#include "model_evaluator.h"
#include "rivals.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kStarted = 0.1, kForward = 0.85;  // of the progress

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What is in a model and was not in the one that the search started with.
Names namesBeyond(const EvaluatedModel& base, const EvaluatedModel& model) {
  Names added;
  for (const std::string& name : model.ranked.effects)
    if (!contains(base.ranked.effects, name)) added.push_back(name);
  return added;
}

/// The residual from which on a fit counts outliers.
double outlierOf(const ModelFit& fit) {
  const Eigen::VectorXd all = joined(fit.residuals);
  const double size = robustDeviation({all.data(), all.data() + all.size()});
  return size > 0.0 ? kOutlierScale * size : 1.0;
}

std::vector<RankedModel> asReported(const std::vector<EvaluatedModel>& ranking) {
  std::vector<RankedModel> models;
  for (const EvaluatedModel& evaluated : ranking) models.push_back(evaluated.ranked);
  std::stable_sort(models.begin(), models.end(),
                   [](const RankedModel& a, const RankedModel& b) { return a.held_out_rmse < b.held_out_rmse; });
  return models;
}

class Search {
 public:
  Search(const Records& records, const HoldOut& held_out, const ModelFit& rough, std::size_t most_forces,
         const DiagnoseOptions& options, const std::optional<StrutModel>& lagged)
      : records_(records),
        options_(options),
        lagged_(lagged),
        evaluator_(records, held_out, outlierOf(rough), most_forces, options, lagged) {}

  SearchResult run(const ModelFit& rough);

 private:
  void report(double share) const {
    if (options_.progress) options_.progress(share);
  }
  void noteGroup(const Selection& selection);
  EvaluatedModel extend(EvaluatedModel current, int round);
  EvaluatedModel extendRivals(EvaluatedModel best);
  EvaluatedModel refine(EvaluatedModel current);
  EvaluatedModel withoutSuperfluous(EvaluatedModel current) const;
  EvaluatedModel reconsidered(EvaluatedModel current, const Names& added, const ModelEvaluator::Tick& tick);
  bool standsAlone(const EvaluatedModel& candidate) const;
  void conclude(const EvaluatedModel& last);
  void name(Verdict verdict, const EvaluatedModel& model);
  FittedModel finalFit(const EvaluatedModel& last) const;

  const Records& records_;
  const DiagnoseOptions& options_;
  const std::optional<StrutModel>& lagged_;
  ModelEvaluator evaluator_;
  EvaluatedModel base_;
  std::optional<Selection> suspect_;    // the best addition to the base
  std::vector<EvaluatedModel> rivals_;  // all that were tried for it
  std::optional<Explanation> explanation_;
  SearchResult result_;
};

void Search::noteGroup(const Selection& selection) {
  if (mayBeTilt(selection.chosen.ranked.model, selection.chosen.added, records_)) {
    Names group = selection.group;
    if (!contains(group, kTilt)) group.emplace_back(kTilt);
    result_.indistinguishable.push_back(group);
    result_.separating.push_back({group, DriveKind::kAtRest, 0.0, 0.0});
    return;
  }
  if (selection.group.size() < 2) return;
  result_.indistinguishable.push_back(selection.group);
  result_.separating.push_back(separatingDrive(evaluator_.motionOf(selection.chosen), selection));
}

// What the first effect explained, the later ones may explain better together.
EvaluatedModel Search::withoutSuperfluous(EvaluatedModel current) const {
  const std::string newest = current.added;
  for (const std::string& name : namesBeyond(base_, current)) {
    if (name == newest) continue;
    const EvaluatedModel without = evaluator_.without(current, name);
    if (without.ranked.fitted && !evaluator_.isWorthHaving(without, current)) current = without;
  }
  return current;
}

// Each effect was chosen before the later ones were known: is it still the one, and with which others is it confused?
EvaluatedModel Search::reconsidered(EvaluatedModel current, const Names& added, const ModelEvaluator::Tick& tick) {
  for (const std::string& name : added) {
    const EvaluatedModel without = evaluator_.without(current, name);
    if (!without.ranked.fitted) continue;
    const std::vector<EvaluatedModel> ranking = evaluator_.rankAdditions(without, tick);
    if (ranking.empty() || !ranking.front().ranked.fitted) continue;
    const Selection selection = select(ranking, evaluator_.heldOut());
    noteGroup(selection);
    if (!contains(selection.group, name) ||
        complexity(selection.chosen.ranked.model) < complexity(current.ranked.model))
      current = selection.chosen;
  }
  return current;
}

// A sensor's fault is one on any drive: what helps only beside other effects imitates a part of theirs.
bool Search::standsAlone(const EvaluatedModel& candidate) const {
  const std::vector<ActiveMeasurementEffect>& readings = candidate.ranked.model.reading;
  if (!candidate.ranked.significant || readings.empty() || readings.back().effect.name != candidate.added) return true;
  StrutModel alone = base_.ranked.model;
  alone.reading.push_back(readings.back());
  const EvaluatedModel evaluated = evaluator_.evaluate(alone, base_.fit.initial, &base_);
  return evaluated.ranked.significant;
}

// Forward selection: the best addition as long as it pays.
// @param round  how many the model has already.
EvaluatedModel Search::extend(EvaluatedModel current, int round) {
  for (; round < options_.most_effects; ++round) {
    const double done = kStarted + kForward * round / options_.most_effects;
    const auto tick = [&](double share) { report(done + kForward * share / options_.most_effects); };
    std::vector<EvaluatedModel> ranking = evaluator_.rankAdditions(current, tick);
    if (round > 0)
      ranking.erase(std::remove_if(ranking.begin(), ranking.end(),
                                   [this](const EvaluatedModel& each) { return !standsAlone(each); }),
                    ranking.end());
    if (round == 0) result_.ranking = asReported(ranking);
    if (ranking.empty() || !ranking.front().ranked.fitted) break;
    if (current.ranked.held_out_rmse < accuracyOfFreeRuns(records_)) break;
    // Whatever a free run leaves of data that it was not fitted to is above the floor.
    result_.noise_floor = std::min(result_.noise_floor, ranking.front().ranked.held_out_rmse);
    if (!ranking.front().ranked.significant) break;
    const Selection selection = select(ranking, evaluator_.heldOut());
    if (round == 0) {
      suspect_ = selection;
      rivals_ = std::move(ranking);
    }
    current = withoutSuperfluous(selection.chosen);
  }
  return current;
}

// Of several effects that which explains most alone need not be one: a law with more numbers takes some of each. So
// every other that was fitted has its turn at being the first.
EvaluatedModel Search::extendRivals(EvaluatedModel best) {
  for (const EvaluatedModel& rival : rivals_) {
    if (!rival.ranked.significant || contains(namesBeyond(base_, best), rival.added)) continue;
    const EvaluatedModel other = extend(rival, 1);
    if (other.loss < best.loss && complexity(other.ranked.model) <= complexity(best.ranked.model)) best = other;
  }
  return best;
}

// Of several effects every one again. That may make one superfluous, which changes what the others are confused with.
EvaluatedModel Search::refine(EvaluatedModel current) {
  const Names found = namesBeyond(base_, current);
  const bool only_suspect = found.size() == 1 && found.front() == suspect_->chosen.added;
  if (only_suspect) noteGroup(*suspect_);
  for (bool changed = !found.empty() && !only_suspect; changed;) {
    result_.indistinguishable.clear();
    result_.separating.clear();
    const auto tick = [this](double) { report(kStarted + kForward); };
    current = reconsidered(current, namesBeyond(base_, current), tick);
    const std::size_t before = current.ranked.effects.size();
    current.added.clear();  // none is too new to go
    current = withoutSuperfluous(current);
    changed = current.ranked.effects.size() < before;
  }
  return current;
}

// To all samples; if the solver does not get there, the numbers of the fit that was judged are not worse than none.
FittedModel Search::finalFit(const EvaluatedModel& last) const {
  const FitOutcome fit = fitOutputError(records_, {}, last.ranked.model, last.fit.initial);
  return fit ? FittedModel{fit->model, fit->stddev, true} : FittedModel{last.fit.model, last.fit.stddev, false};
}

void Search::conclude(const EvaluatedModel& last) {
  if (!suspect_)
    result_.noise_floor = explanation_->floorOf(base_, result_.noise_floor);  // else a law takes a part of it
  result_.structured_share = structuredShare(base_.ranked.held_out_rmse, result_.noise_floor);
  if (result_.structured_share > 0.0)
    result_.surface_share = std::min(1.0, evaluator_.surfaceGain(base_) / result_.structured_share);
  const std::size_t names = namesBeyond(base_, last).size();
  const EvaluatedModel& before = names > 1 ? suspect_->chosen : base_;
  if (names > 0 && explanation_->isExplained(last, before, result_.noise_floor))
    return name(Verdict::kEffectFound, last);
  result_.indistinguishable.clear();
  result_.separating.clear();
  if (suspect_ && explanation_->isSuspect(suspect_->chosen)) {
    noteGroup(*suspect_);
    result_.remainder_surface_share = evaluator_.surfaceGain(suspect_->chosen);
    return name(Verdict::kSuspect, suspect_->chosen);
  }
  const bool structured = suspect_ || isStructured(base_.ranked.held_out_rmse, result_.noise_floor);
  result_.verdict = structured ? Verdict::kUnexplained : Verdict::kNothingMissing;
  result_.base.model.is_complete = !structured;
  if (result_.structured_share > 0.0)
    result_.folded_share =
        foldedMotion(records_, base_.ranked.model) / (std::sqrt(result_.structured_share) * base_.ranked.held_out_rmse);
  result_.turns_body = explanation_->turningShare() > kWorthHaving;
}

void Search::name(Verdict verdict, const EvaluatedModel& model) {
  result_.verdict = verdict;
  result_.selected = namesBeyond(base_, model);
  result_.explained_share = std::min(1.0, explanation_->share(model, result_.noise_floor));
  result_.extended = model.ranked;
  result_.extended_fit_percent = evaluator_.heldOut().fitPercent(model.ranked.held_out_rmse);
  result_.final_fit = finalFit(model);
  if (result_.final_fit)
    result_.final_fit->model.is_complete = !isStructured(model.ranked.held_out_rmse, result_.noise_floor);
}

SearchResult Search::run(const ModelFit& rough) {
  base_ = evaluator_.evaluate(rough.model, rough.initial, nullptr);
  if (!base_.ranked.fitted && lagged_) base_ = evaluator_.asItIs(rough);
  if (!base_.ranked.fitted) {
    result_.shortcoming = Shortcoming::kNoStableFit;
    return result_;
  }
  report(kStarted);
  result_.base = base_.ranked;
  result_.base_fit_percent = evaluator_.heldOut().fitPercent(base_.ranked.held_out_rmse);
  result_.noise_floor = estimateNoiseFloor(records_, base_.ranked.model);
  explanation_.emplace(records_, evaluator_, base_);
  EvaluatedModel last = extend(base_, 0);
  if (namesBeyond(base_, last).size() > 1) last = extendRivals(last);
  last = refine(last);
  // What several names explain no better than one does, one explains.
  if (namesBeyond(base_, last).size() > 1 && !evaluator_.isWorthHaving(suspect_->chosen, last)) {
    result_.indistinguishable.clear();
    result_.separating.clear();
    last = suspect_->chosen;
    noteGroup(*suspect_);
  }
  result_.noise_floor = std::min(result_.noise_floor, last.ranked.held_out_rmse);
  conclude(last);
  report(1.0);
  return result_;
}

SearchResult without(Shortcoming shortcoming) {
  SearchResult nothing;
  nothing.shortcoming = shortcoming;
  return nothing;
}

}  // namespace

SearchResult searchEffects(const Records& records, const StrutModel& start, const DiagnoseOptions& options,
                           const std::optional<StrutModel>& lagged) {
  if (segmentsOf(records).empty()) return without(Shortcoming::kTooShort);
  FitOutcome rough = fitOutputError(records, {}, start);
  if (!rough && lagged)
    rough = withoutFit(records, {lagged->damping_to_mass, lagged->stiffness_to_mass, start.effects, start.reading});
  if (!rough) return without(Shortcoming::kNoStableFit);
  const std::optional<HoldOut> held_out = splitHoldOut(records, rough->model.stiffness_to_mass);
  if (!held_out) return without(Shortcoming::kTooShort);
  const std::size_t most_forces = start.effects.size() + static_cast<std::size_t>(options.most_forces);
  return Search(records, *held_out, *rough, most_forces, options, lagged).run(*rough);
}

}  // namespace suspension_health_monitor
