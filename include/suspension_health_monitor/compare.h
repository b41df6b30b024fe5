#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/residual_views.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// How far a prediction is from the measurement.
struct PredictionError {
  double rmse = 0.0;         ///< [m/s^2]
  double fit_percent = 0.0;  ///< 100 (1 - |y - yhat| / |y - mean y|): 100 is perfect, 0 no better than a constant
};

/// A free run beside the measurement over one segment of a drive: what every plot over time is made of.
/// All vectors have one entry per sample.
struct ComparedSegment {
  std::size_t drive = 0;              ///< which of the drives, from 0
  double start = 0.0;                 ///< time of the first sample since the start of that drive [s]
  double driven_before = 0.0;         ///< how long the drives before it are [s]
  double period = 0.0;                ///< T [s]
  std::vector<double> measured;       ///< z'' less the drive's mean w'' [m/s^2]
  std::vector<double> predicted;      ///< by the free run [m/s^2]
  std::vector<double> wheel;          ///< w'' less its mean [m/s^2]
  std::vector<double> travel;         ///< d of the free run, from its mean position [m], compression positive
  std::vector<double> travel_rate;    ///< v of the free run [m/s]
  std::vector<double> added_force;    ///< sum c_j f_j, the effects' part of the model [m/s^2]
  BodyChannels body;                  ///< what else the body's IMU measured, as far as it is known
  std::vector<double> missing_force;  ///< what the model lacks, per unit mass [m/s^2]; what the residual would be had
                                      ///< the run the right travel (doc/comparison.md)

  std::size_t size() const { return measured.size(); }

  /// @return since the start of the drive [s].
  double time(std::size_t sample) const { return start + static_cast<double>(sample) * period; }

  /// @return time as laws count it [s]: on from drive to drive.
  double timeDriven(std::size_t sample) const { return driven_before + time(sample); }

  /// @return measured - predicted [m/s^2]: positive where the body is pushed up harder than the free run says.
  double residual(std::size_t sample) const { return measured[sample] - predicted[sample]; }

  /// @return the residuals of all samples.
  std::vector<double> residuals() const;
};

/// From which side a failure of the model is seen.
enum class FailureView { kOffset, kTime, kTravel, kTravelRate, kSurface, kDirection, kFrequency, kEverywhere, kNone };

/// A part of the drive where the model fails.
struct FailureRegion {
  /// A parameter that moves during a drive (kTime).
  enum class Drift { kNone, kDamping, kStiffness };

  FailureView view = FailureView::kNone;  ///< kNone: nothing fails; what is left is noise
  std::string region;                     ///< in a few words, e.g. "travel above 21 mm"
  std::string sentence;                   ///< for a mechanic: where, how often, how much, compared with elsewhere
  double rmse = 0.0;                      ///< of the free run in the region; kFrequency: of that band alone [m/s^2]
  double rmse_elsewhere = 0.0;            ///< [m/s^2]; 0 if the region is everything
  double mean = 0.0;                      ///< mean missing force in the region; kOffset: mean residual [m/s^2]
  double share = 1.0;                     ///< of the samples
  double from = 0.0, to = 0.0;  ///< edges: time [s], travel [m], rate [m/s] or frequency [Hz]; of kSurface the travel
  double rate_from = 0.0, rate_to = 0.0;  ///< kSurface: edges of the travel rate [m/s]
  std::size_t drive = 0;                  ///< kTime: which of the drives, from 0
  Drift drift = Drift::kNone;
  double first_third = 0.0, last_third = 0.0;  ///< of a drift: by how much the parameter differs, of its value
  double coherence = 0.0;                      ///< kFrequency: of residual and w'' in the band, 0 .. 1
};

struct CompareOptions {
  std::optional<double> sample_period;  ///< T [s]; nothing: the median spacing of the samples
  std::optional<int>
      horizon_samples;              ///< L of the integral filter for the one-step error; nothing: chosen by the strut
  std::optional<StrutModel> model;  ///< nothing: the linear strut, b1 and b0 by blocks
  /// true: b1, b0, coefficients and shapes are fitted by output error, from the model as the first guess.
  /// false: the model's numbers are judged as they are; only the initial state of every segment is estimated.
  bool fit = true;
  /// Called with the share that is done, 0 .. 1, on the calling thread. What it throws ends the comparison and comes
  /// out of it.
  std::function<void(double share)> progress = {};
};

/// A model beside the measurement: how good it is, and where it fails.
struct Comparison {
  Shortcoming shortcoming = Shortcoming::kNone;  ///< if any: all below but `reason` is empty
  std::string reason;  ///< what is the matter with the drives, to be read after "the drives"; empty if nothing is

  StrutModel model;            ///< as it was compared: with fitted numbers, or as given
  std::vector<double> stddev;  ///< of its numbers, in the order of numbersOf(); empty if they were given

  /// Free run: z'' predicted from w'' alone over whole segments.
  PredictionError free_run;
  /// The same on blocks that the fit has not seen. Nothing if the drives are too short to hold a part out.
  std::optional<double> held_out_rmse;  ///< [m/s^2]
  /// One-step: the rows of the regression with the same numbers, what the live estimators see of the model.
  /// Nothing if no segment is longer than the filter.
  std::optional<PredictionError> one_step;
  int horizon_samples = 0;  ///< L of the rows

  double noise_floor = 0.0;       ///< rmse that the noise of both sensors alone would leave of a free run: an estimate
                                  ///< from the drives, not above the rmse of this model [m/s^2]
  double structured_share = 0.0;  ///< 1 - noise_floor^2 / rmse^2 of the free run, not below 0: what is not noise

  ResidualViews views;
  std::vector<FailureRegion> where;       ///< worst first, never empty
  std::vector<PartialResidual> forces;    ///< one per effect of the model: its force as it is seen
  std::vector<ComparedSegment> segments;  ///< for plots
  std::vector<std::vector<std::pair<double, double>>> held_out;  ///< per drive: [from, to] of the blocks held out [s]

  explicit operator bool() const { return shortcoming == Shortcoming::kNone; }
};

/// Compares a model with recorded drives of one strut: free-run and one-step error, what of it is not noise, and where
/// in travel, rate, time and frequency it lies. doc/comparison.md explains every figure and view.
///
///   Comparison linear = compare({makeDrive(0.01, sprung, unsprung)});
///   if (linear) for (const FailureRegion& region : linear.where) std::cout << region.sentence << '\n';
///
/// @param drives  sampled alike.
/// @return check it with `if`: drives that are too short, too calm or show no strut are a result with a reason.
/// @throws std::invalid_argument  for options that cannot be: a period that is not above 0, no drive.
Comparison compare(const std::vector<Drive>& drives, const CompareOptions& options = {});

}  // namespace suspension_health_monitor
