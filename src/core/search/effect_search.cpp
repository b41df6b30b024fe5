#include "suspension_health_monitor/internal/search/effect_search.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "conclusion.h"

namespace suspension_health_monitor {
namespace {

constexpr double kStarted = 0.1, kForward = 0.85;  // of the progress

/// The residual from which on a fit counts outliers.
double outlierOf(const ModelFit& fit) {
  const Eigen::VectorXd all = joined(fit.residuals);
  const double size = robustDeviation({all.data(), all.data() + all.size()});
  return size > 0.0 ? kOutlierScale * size : 1.0;
}

std::vector<RankedModel> asReported(const std::vector<EvaluatedModel>& ranking) {
  std::vector<RankedModel> models = mapped(ranking, &EvaluatedModel::ranked);
  std::stable_sort(models.begin(), models.end(),
                   [](const RankedModel& a, const RankedModel& b) { return a.held_out_rmse < b.held_out_rmse; });
  return models;
}

class Search {
 public:
  Search(const Records& records, const HoldOut& held_out, const DiagnoseOptions& options,
         const ModelEvaluator& evaluator)
      : records_(records), held_out_(held_out), options_(options), evaluator_(evaluator) {}

  /// @param keeps  whether a search goes on with the rough model as it is where no fit comes of it.
  SearchResult run(const ModelFit& rough, bool keeps) {
    base_ = evaluator_.evaluate(rough.model, rough.initial, nullptr);
    if (!base_.ranked.fitted && keeps) base_ = evaluator_.asItIs(rough);
    if (!base_.ranked.fitted) {
      result_.shortcoming = Shortcoming::kNoStableFit;
      return result_;
    }
    report(kStarted);
    result_.base = base_.ranked;
    result_.base_fit_percent = held_out_.fitPercent(base_.ranked.held_out_rmse);
    result_.noise_floor = estimateNoiseFloor(records_, base_.ranked.model);
    EvaluatedModel last = extend(base_, 0);
    if (namesBeyond(base_, last).size() > 1) last = extendRivals(last);
    last = refine(last);
    // Several names that explain no more than the first one alone give way to it.
    if (namesBeyond(base_, last).size() > 1 && !evaluator_.isWorthHaving(suspect_->chosen, last)) {
      result_.separating.clear();
      last = suspect_->chosen;
      noteGroup(*suspect_, records_, result_.separating);
    }
    result_.noise_floor = std::min(result_.noise_floor, last.ranked.held_out_rmse);
    Conclusion(records_, held_out_, base_, suspect_, result_).conclude(last);
    result_.indistinguishable = mapped(result_.separating, &SeparatingDrive::group);
    report(1.0);
    return result_;
  }

 private:
  void report(double share) const {
    if (options_.progress) options_.progress(share);
  }

  // Forward selection: the best addition as long as it pays.
  // @param round  how many the model has already.
  EvaluatedModel extend(EvaluatedModel current, int round) {
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
      const Selection selection = select(ranking, held_out_);
      if (round == 0) {
        suspect_ = selection;
        rivals_ = std::move(ranking);
      }
      current = withoutSuperfluous(selection.chosen);
    }
    return current;
  }

  // If several effects are missing, the one that explains most alone need not be among them: a law with more numbers
  // takes a part of each. So every other one that was fitted is tried as the first.
  EvaluatedModel extendRivals(EvaluatedModel best) {
    for (const EvaluatedModel& rival : rivals_) {
      if (!rival.ranked.significant || contains(namesBeyond(base_, best), rival.added)) continue;
      const EvaluatedModel other = extend(rival, 1);
      if (other.loss < best.loss && complexity(other.ranked.model) <= complexity(best.ranked.model)) best = other;
    }
    return best;
  }

  // Chooses each of several effects again, beside the others. That may make one superfluous, which changes what the
  // others are confused with.
  EvaluatedModel refine(EvaluatedModel current) {
    const Names found = namesBeyond(base_, current);
    const bool only_suspect = found.size() == 1 && found.front() == suspect_->chosen.added;
    if (only_suspect) noteGroup(*suspect_, records_, result_.separating);
    for (bool changed = !found.empty() && !only_suspect; changed;) {
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

  // What the first effect explained, the later ones may explain better together.
  EvaluatedModel withoutSuperfluous(EvaluatedModel current) const {
    const std::string newest = current.added;
    for (const std::string& name : namesBeyond(base_, current)) {
      if (name == newest) continue;
      const EvaluatedModel without = evaluator_.without(current, name);
      if (without.ranked.fitted && !evaluator_.isWorthHaving(without, current)) current = without;
    }
    return current;
  }

  // Each effect was chosen before the later ones were known: is it still the one, and with which others is it confused?
  EvaluatedModel reconsidered(EvaluatedModel current, const Names& added, const ModelEvaluator::Tick& tick) {
    for (const std::string& name : added) {
      const EvaluatedModel without = evaluator_.without(current, name);
      if (!without.ranked.fitted) continue;
      const std::vector<EvaluatedModel> ranking = evaluator_.rankAdditions(without, tick);
      if (ranking.empty() || !ranking.front().ranked.fitted) continue;
      const Selection selection = select(ranking, held_out_);
      noteGroup(selection, records_, result_.separating);
      if (!contains(selection.group, name) ||
          complexity(selection.chosen.ranked.model) < complexity(current.ranked.model))
        current = selection.chosen;
    }
    return current;
  }

  // A sensor's fault is one on any drive: what helps only beside other effects imitates a part of theirs.
  bool standsAlone(const EvaluatedModel& candidate) const {
    const std::vector<ActiveMeasurementEffect>& readings = candidate.ranked.model.reading;
    if (!candidate.ranked.significant || readings.empty() || readings.back().effect.name != candidate.added)
      return true;
    StrutModel alone = base_.ranked.model;
    alone.reading.push_back(readings.back());
    const EvaluatedModel evaluated = evaluator_.evaluate(alone, base_.fit.initial, &base_);
    return evaluated.ranked.significant;
  }

  const Records& records_;
  const HoldOut& held_out_;
  const DiagnoseOptions& options_;
  const ModelEvaluator& evaluator_;
  EvaluatedModel base_;
  std::optional<Selection> suspect_;    // the best addition to the base
  std::vector<EvaluatedModel> rivals_;  // all that were tried for it
  SearchResult result_;
};

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
  const ModelEvaluator evaluator(records, *held_out, outlierOf(*rough), start.effects.size() + options.most_forces,
                                 options, lagged);
  return Search(records, *held_out, options, evaluator).run(*rough, lagged.has_value());
}

}  // namespace suspension_health_monitor
