#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

enum class Verdict {
  kEffectFound,     ///< Diagnosis::selected names what the model lacks
  kSuspect,         ///< it names one effect, or a group, that takes most of the structure but leaves some
  kNothingMissing,  ///< what the model leaves is noise
  kUnexplained      ///< structure is left and no candidate takes most of it: no name is better than a false one
};

/// A model with some effects added, fitted on two thirds of the drives and judged by the rest, which no fit has seen.
struct RankedModel {
  std::vector<std::string> effects;  ///< names of all that is in the model
  StrutModel model;
  bool fitted = false;                     ///< false: screened only, the figures are what a fit is expected to give
  FitFailure failure = FitFailure::kNone;  ///< if any: why there is no such model; the figures are of the one before
  double held_out_rmse = 0.0;              ///< [m/s^2]
  double error_removed_percent = 0.0;      ///< of the mean square that the model before left
  double significance = 0.0;               ///< t of the improvement over held-out stretches, against the model before
  bool significant = false;                ///< by that, corrected for the number of candidates; of fitted models only
};

/// A model with its uncertainty.
struct FittedModel {
  StrutModel model;
  std::vector<double> stddev;  ///< of its numbers, in the order of numbersOf()
  bool all_samples = true;     ///< false: that fit failed, and these are the numbers of the one to two thirds of them
};

struct DiagnoseOptions {
  std::optional<double> sample_period;  ///< T [s]; nothing: the median spacing of the samples
  std::optional<int> horizon_samples;   ///< L for how fast a strut the first guess is sought; nothing: a car's
  /// Where to start: effects that it has stay in the model and are fitted again, and the search is for what is missing
  /// beside them. Nothing: the linear strut, b1 and b0 by blocks of the drives.
  std::optional<StrutModel> model;
  EffectLibrary candidates = builtInEffects();
  int threads = 2;       ///< the result is the same for any number
  int most_effects = 3;  ///< to add
  int most_forces = 2;   ///< among them: three can imitate almost any law of travel and travel rate
  /// Called every now and then with the share that is done, 0 .. 1, on the calling thread. What it throws ends the
  /// search and comes out of diagnose(): the way to cancel.
  std::function<void(double share)> progress = {};
};

/// What a search found.
struct Diagnosis {
  Shortcoming shortcoming = Shortcoming::kNone;  ///< if any: all below but `reason` is empty
  std::string reason;  ///< what is the matter with the drives, to be read after "the drives"; empty if nothing is

  Verdict verdict = Verdict::kNothingMissing;
  std::string summary;                ///< the verdict in a sentence
  RankedModel base;                   ///< the model that the search started with, fitted
  double base_fit_percent = 0.0;      ///< 100 (1 - |y - yhat| / |y - mean y|) on what was held out
  double noise_floor = 0.0;           ///< what sensor noise alone would leave of a free run [m/s^2]
  double structured_share = 0.0;      ///< share of the base's held-out mean square that is not noise
  double surface_share = 0.0;         ///< share of that which a free-form force over travel and travel rate takes
  std::vector<RankedModel> ranking;   ///< single effects, best first
  std::vector<std::string> selected;  ///< names of what is to be added to the model; the suspect
  std::vector<std::vector<std::string>> indistinguishable;  ///< groups that these drives cannot tell apart
  std::string suggested_drive;  ///< sentences: what to record next, to tell a group apart or explain the rest
  std::vector<std::pair<std::string, std::string>> not_tried;  ///< candidates that these drives cannot tell, and why

  /// With kEffectFound and kSuspect:
  double explained_share = 0.0;  ///< of the structure, what the effects named take
  std::string remainder;         ///< with kSuspect: what is left, in a sentence
  /// The model with what was found, as judged, and fitted to all samples.
  std::optional<RankedModel> extended;
  std::optional<FittedModel> final_fit;
  double extended_fit_percent = 0.0;

  Stamp from{}, to{};  ///< first and last sample of the first and the last drive

  explicit operator bool() const { return shortcoming == Shortcoming::kNone; }

  /// @return the model to go on with: final_fit, or the base where nothing was added.
  const StrutModel& model() const { return final_fit ? final_fit->model : base.model; }
};

/// Searches for the physical effects that a strut model lacks, from recorded accelerations of body and wheel alone.
///
/// Every candidate is screened by its linear response; those that may be the best are added to the model, fitted by
/// output error (the free run, driven by the measured w'', is to follow the measured z'') and judged by blocks that no
/// fit has seen. The best one stays if the improvement is significant, corrected for the number of candidates, and
/// worth having; then the next; and what a later one makes superfluous goes. doc/effect_search.md has the details and
/// how often it is right.
///
///   Diagnosis found = diagnose({makeDrive(0.01, sprung, unsprung)});
///   if (!found) std::cerr << "the drives " << found.reason;
///   else std::cout << found.summary;
///
/// Two minutes on a road are enough for most effects; it takes about a second of processor time.
/// @param drives  of one strut, sampled alike; several are fitted together.
/// @return check it with `if`: drives that are too short or show no strut are a result with a reason.
/// @throws std::invalid_argument  for options that cannot be: a period that is not above 0, no thread, no drive.
Diagnosis diagnose(const std::vector<Drive>& drives, const DiagnoseOptions& options = {});

/// A force over the body's mass as a function of one variable: linear between nodes, 0 at 0. It ends where its standard
/// deviation is above a tenth of the force there and of the linear model's usual (rms) one. Empty: nothing is known.
struct ForceCurve {
  std::vector<double> at;      ///< nodes, ascending, one of them 0 [m/s] or [m]
  std::vector<double> force;   ///< positive: pushes the body up [m/s^2]
  std::vector<double> stddev;  ///< by noise and by what straight lines miss: force +- 1.645 stddev holds nine tenths of
                               ///< the law [m/s^2]
  double model_error = 0.0;  ///< relative standard deviation of all forces alike, by what the model of a vehicle lacks
                             ///< [-]: not in stddev, since it does not change between drives

  /// @return the curve with the model's error in stddev, for a comparison with the law itself.
  ForceCurve absolute() const;

  bool covers(double x) const { return !at.empty() && x >= at.front() && x <= at.back(); }

  /// @pre covers(x).
  double forceAt(double x) const;
  double stddevAt(double x) const;
};

/// What damper and spring do, as drives show it: z'' = damper(v) + spring(d) and what the model's effects add that
/// neither variable decides alone (memory, d^2 v, t v; those of time as they are at the start).
///
/// Both are 0 at 0, so that travel counts from where the strut would rest. A constant force cannot be told from an
/// offset of a sensor: it is in neither. Forces of other laws with memory, or of two variables, that the model lacks
/// come into the curves in part, and the standard deviations do not know of them.
struct StrutCurves {
  ForceCurve damper;  ///< over travel rate v: compression above 0, rebound below
  ForceCurve spring;  ///< over travel d: compression above 0
};

/// Output-error fit of two piecewise linear laws with nodes where they bend (doc/equations.md, Curves).
/// @param drives  of one strut, sampled alike.
/// @param model  a damped spring to start with. Its laws of one variable are the first guess; the others, and the
/// faults of the reading, are taken as they are.
/// @param sample_period  T [s]; nothing: the median spacing of the samples.
/// @param model_error  of damper and spring, as VehicleCoupling::strut_model_errors has it.
/// @return empty curves if the drives are too short, or the model does not fit them at all.
/// @throws std::invalid_argument  if there is no drive, the period is not above 0 or an effect is not usable.
StrutCurves strutCurves(const std::vector<Drive>& drives, const StrutModel& model,
                        const std::optional<double>& sample_period = {}, const std::array<double, 2>& model_error = {});

}  // namespace suspension_health_monitor
