#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "suspension_health_monitor/discrepancy/drive_record.h"
#include "suspension_health_monitor/model/strut_integrator.h"

namespace suspension_health_monitor {

/// Which samples of a segment count in a fit: one flag per sample.
using SampleMask = std::vector<char>;

/// FreeRun::follow() over a segment from a given state, with the faults of the reading that the model has.
/// @param predicted  z'' at every sample [m/s^2]; resized.
/// @param motion  travel and travel rate at every sample, if wanted.
/// @return false if the model runs away: it is not stable under this drive.
bool runFree(const StrutModel& model, const DriveRecord& record, const DriveSegment& segment, StrutState state,
             std::vector<double>& predicted, std::vector<StrutState>* motion = nullptr);

struct FitOptions {
  int max_iterations = 25;
  double outlier_scale = 4.0;            ///< residuals beyond this many (robust) standard deviations lose weight
  std::vector<StrutState> initial = {};  ///< first guess of the initial states, per segment; empty: at rest
};

/// A model fitted by output error, with the initial state of every segment.
struct ModelFit {
  StrutModel model;
  std::vector<StrutState> initial;             ///< per segment
  std::vector<std::vector<double>> residuals;  ///< measured - predicted, per segment and sample [m/s^2]
  Eigen::VectorXd stddev;  ///< of b1, b0, coefficient and shapes effect by effect, then of the reading's coefficients
};

/// Fits b1, b0, coefficients, shapes and the initial state of every segment so that the free run follows the measured
/// z'' of all records, in the sense of a robust sum of squares (smooth Huber loss).
/// Solver: Ceres, Levenberg-Marquardt, derivatives by differences, initial states eliminated (Schur complement).
/// @param records  drives that share the model.  @param masks  per record and segment; empty: all samples.
/// @param start  first guess; also sets the scale of every parameter that is not 0 in it.
/// @return nothing if the model runs away or the solver fails.
std::optional<ModelFit> fitOutputError(const std::vector<const DriveRecord*>& records,
                                       const std::vector<std::vector<SampleMask>>& masks, const StrutModel& start,
                                       const FitOptions& options = {});

}  // namespace suspension_health_monitor
