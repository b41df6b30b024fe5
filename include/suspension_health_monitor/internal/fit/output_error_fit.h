#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/record/motion.h"

namespace suspension_health_monitor {

/// Which samples of a segment count in a fit: one flag per sample.
using SampleMask = std::vector<char>;

/// measured - predicted, per segment of all records and sample [m/s^2].
using Residuals = std::vector<std::vector<double>>;

/// Motion of free runs, per segment of all records and sample.
using FreeMotion = std::vector<std::vector<StrutState>>;

/// @return of all segments, one after the other: what is kept by segment and sample.
template <class Value>
Eigen::VectorXd joined(const std::vector<std::vector<Value>>& segments) {
  std::vector<double> all;
  for (const std::vector<Value>& segment : segments) all.insert(all.end(), segment.begin(), segment.end());
  return Eigen::Map<const Eigen::VectorXd>(all.data(), all.size());
}

/// @return of all segments; 0 of none.
double meanOf(const Residuals& residuals);
double meanSquare(const Residuals& residuals);

/// @return rms of what else the body's IMU measured, by channel; 0 where it is not known.
std::array<double, kNumBodyChannels> bodySizes(const Segments& segments);

/// Runs a model over a segment from a state, as FreeRun does; what it predicts has passed the filter of the segment's
/// signals and has the faults of the reading that the model has.
/// @param state  lead() samples before the first one.
/// @param predicted  z'' at every sample [m/s^2]; resized.
/// @param motion  travel and travel rate at every sample, if wanted.
/// @return false if the model runs away: it is not stable under this drive.
bool runFree(const StrutModel& model, const DriveSegment& segment, StrutState state, std::vector<double>& predicted,
             std::vector<StrutState>* motion = nullptr);

/// What a model leaves of the measurement when it runs freely over all segments.
/// @param initial  states in which the segments begin.  @param motion  if wanted.
/// @return nothing if the model runs away.
std::optional<Residuals> freeRunResiduals(const StrutModel& model, const Segments& segments,
                                          const std::vector<StrutState>& initial, FreeMotion* motion = nullptr);

/// Residuals beyond this many (robust) standard deviations lose weight in fits and in comparisons of models.
inline constexpr double kOutlierScale = 4.0;

/// A model fitted by output error, with the initial state of every segment.
struct ModelFit {
  StrutModel model;
  std::vector<StrutState> initial;  ///< per segment
  Residuals residuals;
  std::vector<double> stddev;  ///< of the model's numbers, in the order of numbersOf()
  MotionScale motion;          ///< that the ranges of shapes were counted in
};

/// A fit, or why there is none.
struct FitOutcome : std::optional<ModelFit> {
  FitOutcome(ModelFit fit) : std::optional<ModelFit>(std::move(fit)) {}
  FitOutcome(FitFailure why) : failure(why) {}

  FitFailure failure = FitFailure::kNone;
};

/// Fits b1, b0, coefficients, shapes and the initial state of every segment so that the free run follows the measured
/// z'' of all records, in the sense of a robust sum of squares (smooth Huber loss).
/// Solver: Ceres, Levenberg-Marquardt, derivatives by differences, initial states eliminated (Schur complement).
/// @param records  drives that share the model.  @param masks  per segment of all records; empty: all samples.
/// @param start  first guess, b0 > 0; also sets the scale of every parameter that is not 0 in it.
/// @param initial  first guess of the initial states, per segment; empty: at rest.
/// @return no fit if the model runs away, an effect never acts, the solver fails, or what comes out cannot be compared,
/// searched or simulated: no spring is left (b0 <= 0), or it is too fast for the sampling.
FitOutcome fitOutputError(const Records& records, const std::vector<SampleMask>& masks, const StrutModel& start,
                          const std::vector<StrutState>& initial = {});

/// A model as it is, with the residuals of its free run from rest.
/// @return no fit if the model runs away.
FitOutcome withoutFit(const Records& records, const StrutModel& model);

/// Travel and travel rate at the start of every segment, the model's numbers being given: as fitOutputError() finds
/// them.
/// @param model  b1, b0 > 0.
/// @return one state per segment of all records; nothing if the model runs away.
std::optional<std::vector<StrutState>> estimateInitialStates(const Records& records, const StrutModel& model);

}  // namespace suspension_health_monitor
