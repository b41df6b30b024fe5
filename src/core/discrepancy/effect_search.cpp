#include "suspension_health_monitor/discrepancy/effect_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "suspension_health_monitor/discrepancy/held_out.h"

namespace suspension_health_monitor {
namespace {

constexpr double kFalseName = 0.001;         // chance of a false name, before correction for the number of candidates
constexpr double kWorthHaving = 0.02;        // of the mean square
constexpr double kStructured = 0.25;         // of the mean square; below it, what is left counts as noise
constexpr double kExplained = 0.5;           // of the structure, or there is no name
constexpr double kIndistinguishable = 0.02;  // of the mean square, or not significant

struct Sizes {
  double travel = 0.0, travel_rate = 0.0;
};

Sizes sizesOf(const ModelFit& fit, const std::vector<const DriveRecord*>& records) {
  Sizes sizes;
  double count = 0.0;
  std::size_t index = 0;
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  for (const DriveRecord* record : records)
    for (const DriveSegment& segment : record->segments()) {
      runFree(fit.model, *record, segment, fit.initial[index++], predicted, &motion);
      for (const StrutState& state : motion) {
        sizes.travel += state.travel * state.travel;
        sizes.travel_rate += state.travel_rate * state.travel_rate;
      }
      count += static_cast<double>(motion.size());
    }
  return {std::sqrt(sizes.travel / count), std::sqrt(sizes.travel_rate / count)};
}

double scaleOf(const ShapeParameter& shape, const Sizes& sizes, double stiffness_to_mass) {
  switch (shape.scale) {
    case ShapeScale::kTravel:
      return sizes.travel;
    case ShapeScale::kTravelRate:
      return sizes.travel_rate;
    case ShapeScale::kTime:
      return 1.0 / std::sqrt(stiffness_to_mass);
    case ShapeScale::kNone:
      break;
  }
  return 1.0;
}

/// Starting values spread evenly (in ratio) over the range: shapes have local minima.
std::vector<std::vector<double>> startingShapes(const ForceEffect& effect, const Sizes& sizes, double stiffness) {
  std::vector<std::vector<double>> result{{}};
  for (const ShapeParameter& shape : effect.shapes) {
    const double ratio = shape.max / shape.min;
    const int count = std::clamp(static_cast<int>(std::lround(std::log(ratio) / std::log(4.0))), 2, 3);
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& shapes : result)
      for (int i = 0; i < count; ++i) {
        longer.push_back(shapes);
        longer.back().push_back(scaleOf(shape, sizes, stiffness) * shape.min * std::pow(ratio, (i + 0.5) / count));
      }
    result = std::move(longer);
  }
  return result;
}

std::vector<std::string> namesOf(const StrutModel& model) {
  std::vector<std::string> names;
  for (const ActiveEffect& active : model.effects) names.push_back(active.effect.name);
  for (const ActiveMeasurementEffect& reading : model.reading) names.push_back(reading.effect.name);
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What `names` has and the model that the search started with has not.
std::vector<std::string> namesBeyond(const std::vector<std::string>& start, const std::vector<std::string>& names) {
  std::vector<std::string> added;
  for (const std::string& name : names)
    if (!has(start, name)) added.push_back(name);
  return added;
}

/// The current model with one thing added, for every thing that could be and every set of its starting shapes.
std::vector<StrutModel> makeTrials(const EffectLibrary& candidates, const StrutModel& current, const Sizes& sizes) {
  std::vector<StrutModel> trials;
  const std::vector<std::string> present = namesOf(current);
  for (const ForceEffect& effect : candidates.forces) {
    if (has(present, effect.name) || current.effects.size() >= StrutState::kMostEffects) continue;
    for (const std::vector<double>& shapes : startingShapes(effect, sizes, current.stiffness_to_mass)) {
      trials.push_back(current);
      trials.back().effects.push_back({effect, 0.0, shapes});
    }
  }
  for (const MeasurementEffect& effect : candidates.readings) {
    if (has(present, effect.name)) continue;
    trials.push_back(current);
    trials.back().reading.push_back({effect, 0.0});
  }
  return trials;
}

/// Free parameters of a model: the simpler of two equal ones is preferred.
std::size_t complexity(const StrutModel& model) {
  std::size_t count = model.reading.size();
  for (const ActiveEffect& active : model.effects) count += 1 + active.shapes.size();
  return count;
}

class Search {
 public:
  Search(const EffectLibrary& candidates, const SearchOptions& options,
         const std::vector<const DriveRecord*>& records, const EffectSearch::Progress& progress)
      : candidates_(candidates), options_(options), records_(records), progress_(progress) {}

  std::optional<SearchResult> run(const StrutModel& start);

 private:
  struct Judged {
    RankedModel ranked;
    std::vector<double> stretches;  // held-out sum of squares by stretch
    double training = 0.0;
  };

  std::optional<Judged> judge(const StrutModel& start, const Judged* before) const;
  std::vector<Judged> judgeAll(const std::vector<StrutModel>& trials, const Judged& before) const;
  Judged select(const std::vector<Judged>& ranking, SearchResult& result) const;
  void conclude(const Judged& base, const Judged& last, SearchResult& result) const;

  const EffectLibrary& candidates_;
  const SearchOptions& options_;
  const std::vector<const DriveRecord*>& records_;
  const EffectSearch::Progress& progress_;
  HeldOut held_out_{};
};

std::optional<Search::Judged> Search::judge(const StrutModel& start, const Judged* before) const {
  const std::optional<ModelFit> fit = fitOutputError(records_, held_out_.training, start);
  if (!fit) return std::nullopt;
  Judged judged;
  judged.ranked.model = fit->model;
  judged.ranked.effects = namesOf(fit->model);
  judged.stretches = held_out_.stretchErrors(fit->residuals);
  judged.training = held_out_.trainingError(fit->residuals);
  judged.ranked.held_out_rmse = held_out_.rmse(judged.stretches);
  if (before != nullptr) {
    const PairedComparison gain = comparePaired(before->stretches, judged.stretches);
    judged.ranked.error_removed_percent = 100.0 * gain.removed_share;
    judged.ranked.significance = gain.t;
    const auto tests = static_cast<double>(candidates_.forces.size() + candidates_.readings.size());
    judged.ranked.significant = gain.removed_share > kWorthHaving && isSignificant(gain, kFalseName / tests);
  }
  return judged;
}

std::vector<Search::Judged> Search::judgeAll(const std::vector<StrutModel>& trials, const Judged& before) const {
  std::vector<std::optional<Judged>> results(trials.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < trials.size(); i = next++) results[i] = judge(trials[i], &before);
  };
  std::vector<std::thread> helpers;
  for (int i = 1; i < options_.threads; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();

  std::vector<Judged> ranking;  // of several starting shapes of one effect the best in training stays
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!results[i]) continue;
    const auto same = std::find_if(ranking.begin(), ranking.end(), [&](const Judged& judged) {
      return judged.ranked.effects == results[i]->ranked.effects;
    });
    if (same == ranking.end())
      ranking.push_back(*results[i]);
    else if (results[i]->training < same->training)
      *same = *results[i];
  }
  std::sort(ranking.begin(), ranking.end(),
            [](const Judged& a, const Judged& b) { return a.ranked.held_out_rmse < b.ranked.held_out_rmse; });
  return ranking;
}

Search::Judged Search::select(const std::vector<Judged>& ranking, SearchResult& result) const {
  const Judged& best = ranking.front();
  std::vector<std::string> group;
  const Judged* simplest = &best;
  for (const Judged& rival : ranking) {
    const PairedComparison loss = comparePaired(rival.stretches, best.stretches);
    if (loss.removed_share > kIndistinguishable || isSignificant(loss, 0.01)) continue;
    group.push_back(rival.ranked.effects.back());
    if (complexity(rival.ranked.model) < complexity(simplest->ranked.model)) simplest = &rival;
  }
  if (group.size() > 1) result.indistinguishable.push_back(group);
  return *simplest;
}

std::optional<SearchResult> Search::run(const StrutModel& start) {
  const auto report = [this](double share) {
    if (progress_) progress_(share);
  };
  const std::optional<ModelFit> rough = fitOutputError(records_, {}, start);
  if (!rough) return std::nullopt;
  const std::optional<HeldOut> held_out = holdOut(records_, rough->model.stiffness_to_mass);
  if (!held_out) return std::nullopt;
  held_out_ = *held_out;
  const std::optional<Judged> base = judge(rough->model, nullptr);
  if (!base) return std::nullopt;
  report(0.1);

  SearchResult result;
  result.base = base->ranked;
  result.base_fit_percent = held_out_.fitPercent(base->ranked.held_out_rmse);
  result.noise_floor = estimateNoiseFloor(records_, base->ranked.model);
  const Sizes sizes = sizesOf(*rough, records_);
  Judged current = *base;
  for (int round = 0; round < options_.most_effects; ++round) {
    const std::vector<Judged> ranking = judgeAll(makeTrials(candidates_, current.ranked.model, sizes), current);
    report(0.1 + 0.9 * (round + 1) / options_.most_effects);
    if (round == 0)
      for (const Judged& judged : ranking) result.ranking.push_back(judged.ranked);
    if (ranking.empty() || !ranking.front().ranked.significant) break;
    current = select(ranking, result);
  }
  conclude(*base, current, result);
  report(1.0);
  return result;
}

void Search::conclude(const Judged& base, const Judged& last, SearchResult& result) const {
  const auto square = [](double x) { return x * x; };
  const double floor = square(result.noise_floor);
  const double structure = square(base.ranked.held_out_rmse) - floor;
  const double left = square(last.ranked.held_out_rmse) - floor;
  result.structured_share = std::clamp(structure / square(base.ranked.held_out_rmse), 0.0, 1.0);
  const std::vector<std::string> added = namesBeyond(base.ranked.effects, last.ranked.effects);
  const bool found = !added.empty();
  if (found && left < (1.0 - kExplained) * structure) {
    result.verdict = Verdict::kEffectFound;
    result.selected = added;
    result.extended = last.ranked;
    result.extended_fit_percent = held_out_.fitPercent(last.ranked.held_out_rmse);
    result.final_fit = fitOutputError(records_, {}, last.ranked.model);
    return;
  }
  result.indistinguishable.clear();
  result.verdict = found || result.structured_share > kStructured ? Verdict::kUnexplained : Verdict::kNothingMissing;
}

}  // namespace

EffectSearch::EffectSearch(EffectLibrary candidates, const SearchOptions& options)
    : candidates_(std::move(candidates)), options_(options) {}

std::optional<SearchResult> EffectSearch::run(const std::vector<const DriveRecord*>& records, const StrutModel& start,
                                              const Progress& progress) const {
  return Search(candidates_, options_, records, progress).run(start);
}

}  // namespace suspension_health_monitor
