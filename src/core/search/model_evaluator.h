#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "row_start.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/search/effect_search.h"
#include "suspension_health_monitor/internal/search/screening.h"

namespace suspension_health_monitor {

/// A model and how it did, or is expected to do, on what was held out.
struct EvaluatedModel {
  RankedModel ranked;
  std::string added;                       ///< what it has and the model before had not
  double training_gain = 0.0;              ///< as ScreenedModel has it
  std::optional<StrutModel> second_start;  ///< for a fit, if the first fails
  ModelFit fit;                            ///< empty unless ranked.fitted
  std::vector<double> stretches;           ///< held-out loss by stretch
  double loss = 0.0;                       ///< their sum
  double independent = 0.0;                ///< HoldOut::independentSquares()
  double to_explain = 0.0;                 ///< the loss of the model that the search began with

  /// @return true if it was fitted or has failed; false: only screened.
  bool isTried() const { return ranked.fitted || ranked.failure != FitFailure::kNone; }

  PairedTest gainOf(const EvaluatedModel& after) const { return testPaired(stretches, after.stretches, independent); }
};

using Names = std::vector<std::string>;

inline bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What is in a model and was not in the one that the search started with.
inline Names namesBeyond(const EvaluatedModel& base, const EvaluatedModel& model) {
  Names added;
  for (const std::string& name : model.ranked.effects)
    if (!contains(base.ranked.effects, name)) added.push_back(name);
  return added;
}

/// Free parameters of a model beyond b1 and b0: the simpler of two equal ones is preferred.
std::size_t complexity(const StrutModel& model);

/// Probability at which one of two rivals is better by chance.
inline constexpr double kSure = 0.01;

/// Fits models on the training samples of the drives and evaluates them on the rest.
class ModelEvaluator {
 public:
  using Tick = std::function<void(double share)>;

  /// @param outlier  residual that begins to count as an outlier [m/s^2].
  /// @param most_forces  force effects that a model may have.  @param lagged  as searchEffects() has it.
  /// The arguments must outlive this object.
  ModelEvaluator(const Records& records, const HoldOut& held_out, double outlier, std::size_t most_forces,
                 const DiagnoseOptions& options, const std::optional<StrutModel>& lagged);

  /// @param initial  first guess of the initial states.  @param before  the model to compare with, if any.
  /// @return check ranked.fitted: a fit that failed, or came to what physics does not allow, is a result with a reason.
  EvaluatedModel evaluate(const StrutModel& start, const std::vector<StrutState>& initial,
                          const EvaluatedModel* before) const;

  /// Evaluates a model without fitting it.
  EvaluatedModel asItIs(const ModelFit& fit) const;

  /// Every candidate that is not in the model added to it: all screened, those fitted that may be the best.
  /// @return best first, those that were fitted before those that were only screened.
  std::vector<EvaluatedModel> rankAdditions(const EvaluatedModel& current, const Tick& tick) const;

  /// The model with one of its effects taken out.
  EvaluatedModel without(const EvaluatedModel& evaluated, const std::string& effect) const;

  /// @return true if `after` is better by enough of what there was to explain, and not by chance, correcting for the
  /// number of candidates.
  bool isWorthHaving(const EvaluatedModel& before, const EvaluatedModel& after) const;

 private:
  std::vector<EvaluatedModel> screenAll(const EvaluatedModel& current, const Tick& tick) const;
  void fitAll(const std::vector<std::size_t>& wanted, const EvaluatedModel& current,
              std::vector<EvaluatedModel>& ranking, const Tick& tick) const;
  std::optional<EvaluatedModel> screen(const ForceEffect& effect, const Screening& screening, const RowStart& row_start,
                                       const EvaluatedModel& current) const;
  std::optional<EvaluatedModel> screen(const MeasurementEffect& reading, const Screening& screening,
                                       const EvaluatedModel& current) const;
  EvaluatedModel expected(const std::string& added, const ScreenedModel& screened, const EvaluatedModel& current) const;
  EvaluatedModel weighed(const StrutModel& model, const Residuals& residuals) const;
  void rank(const EvaluatedModel& before, EvaluatedModel& evaluated) const;
  FitFailure againstPhysics(const ModelFit& fit) const;
  bool isConfoundedWithFrequency(const EvaluatedModel& candidate, const EvaluatedModel& current) const;
  bool wanders(const EvaluatedModel& candidate, const EvaluatedModel& current) const;

  const Records& records_;
  const HoldOut& held_out_;
  double outlier_;
  std::size_t most_forces_;
  const DiagnoseOptions& options_;
  const std::optional<StrutModel>& lagged_;
};

}  // namespace suspension_health_monitor
