#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "suspension_health_monitor/discrepancy/compared_segment.h"
#include "suspension_health_monitor/discrepancy/drive_record.h"
#include "suspension_health_monitor/discrepancy/prediction_error.h"
#include "suspension_health_monitor/discrepancy/residual_views.h"
#include "suspension_health_monitor/discrepancy/where_it_fails.h"

namespace suspension_health_monitor {

struct ComparisonOptions {
  /// true: b1, b0, coefficients and shapes are fitted by output error, from the model given as the first guess.
  /// false: the model's numbers are judged as they are; only the initial state of every segment is estimated.
  bool fit = true;
  /// Horizon of the integral filter in samples for the one-step error; nothing: proposed from b1 and b0.
  std::optional<int> horizon_samples;
};

/// A model beside the measurement: how good it is, and where it fails.
struct Comparison {
  StrutModel model;        ///< as it was compared: with fitted numbers, or as given
  Eigen::VectorXd stddev;  ///< of its numbers as in ModelFit; empty if they were given

  /// Free run: z'' predicted from w'' alone over whole segments.
  PredictionError free_run;
  /// The same on blocks that the fit has not seen (held_out.h). Nothing if the drives are too short to hold a part out.
  std::optional<double> held_out_rmse;  ///< [m/s^2]
  /// One-step: the rows of the regression, with the same numbers; see oneStepError().
  /// Nothing if no segment is longer than the filter.
  std::optional<PredictionError> one_step;
  int horizon_samples = 0;  ///< L of the rows

  double noise_floor = 0.0;       ///< rmse that the noise of both sensors alone would leave of a free run: as estimated
                                  ///< by estimateNoiseFloor(), not above the rmse of this one [m/s^2]
  double structured_share = 0.0;  ///< 1 - noise_floor^2 / rmse^2 of the free run, not below 0: what is not noise

  ResidualViews views;
  std::vector<FailureRegion> where;       ///< worst first, never empty
  std::vector<ComparedSegment> segments;  ///< for plots
};

/// Compares a model with drives of one vehicle.
/// @param records  of one sampling period.  @param progress  told how much is done, 0 .. 1.
/// @return nothing if the drives hold too little (no segment, nothing moves), or the model is not stable on them.
std::optional<Comparison> compareModel(const std::vector<const DriveRecord*>& records, const StrutModel& model,
                                       const ComparisonOptions& options = {},
                                       const std::function<void(double share)>& progress = {});

}  // namespace suspension_health_monitor
