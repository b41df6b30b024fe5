#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/discrepancy/output_error_fit.h"
#include "suspension_health_monitor/model/effect_library.h"

namespace suspension_health_monitor {

enum class Verdict { kEffectFound, kNothingMissing, kUnexplained };

/// A model with some effects added, fitted on the training blocks and judged on the held-out ones.
struct RankedModel {
  std::vector<std::string> effects;  ///< names of all that is in the model
  StrutModel model;
  bool fitted = false;         ///< false: screened only (screening.h), the figures are what a fit is expected to give
  double held_out_rmse = 0.0;  ///< [m/s^2]
  double error_removed_percent = 0.0;  ///< of the mean square that the model before left
  double significance = 0.0;           ///< t of the improvement over held-out stretches, against the model before
  bool significant = false;            ///< by that, corrected for the number of candidates; of fitted models only
};

/// What a search found.
struct SearchResult {
  Verdict verdict = Verdict::kNothingMissing;
  RankedModel base;
  double base_fit_percent = 0.0;
  double noise_floor = 0.0;       ///< what sensor noise alone would leave of a free run [m/s^2]
  double structured_share = 0.0;  ///< share of the base's held-out mean square that is not noise
  double surface_share = 0.0;     ///< share of that structure which a free-form force over travel and travel rate takes
  std::vector<RankedModel> ranking;                         ///< single effects, best first
  std::vector<std::string> selected;                        ///< what was added to the start
  std::vector<std::vector<std::string>> indistinguishable;  ///< groups that these drives cannot tell apart
  std::string suggested_drive;                              ///< a sentence: what would separate them; may be empty
  std::optional<RankedModel> extended;
  std::optional<ModelFit> final_fit;  ///< of the selected model on all samples
  double extended_fit_percent = 0.0;
};

struct SearchOptions {
  int threads = 2;
  int most_effects = 3;  ///< to add
  int most_forces = 2;   ///< among them: three can imitate almost any law of travel and travel rate
};

/// Searches for the physical effects that a strut model lacks.
///
/// Every candidate is screened by its linear response; those that may be the best are added to the model, fitted by
/// output error on two thirds of the drives, and judged by the free run's error on the rest: contiguous blocks that no
/// fit has seen. The best one stays if the improvement is significant over the held-out stretches (paired test,
/// corrected for the number of candidates) and worth having; then the next; and what a later one makes superfluous
/// goes. A name is given only if the result explains most of the structure; else the verdict is "unexplained".
class EffectSearch {
 public:
  /// Called every now and then on the thread that called run(). If it throws, run() ends and passes that on.
  using Progress = std::function<void(double share)>;

  EffectSearch(EffectLibrary candidates, const SearchOptions& options);

  /// @param records  drives of one vehicle.  @param start  rough b1, b0, e.g. of LS; effects that it has stay in the
  /// model and are fitted again, and the search is for what is missing beside them.
  /// @return nothing if the drives are too short to hold out a part of them, or not even the base model can be fitted.
  std::optional<SearchResult> run(const std::vector<const DriveRecord*>& records, const StrutModel& start,
                                  const Progress& progress = {}) const;

 private:
  EffectLibrary candidates_;
  SearchOptions options_;
};

}  // namespace suspension_health_monitor
