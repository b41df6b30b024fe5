#pragma once

#include <Eigen/Core>
#include <optional>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"
#include "suspension_health_monitor/internal/search/weighted_projection.h"

namespace suspension_health_monitor {

/// A candidate as the screening sees it: the model with the effect added, where a fit would best begin, and the
/// residuals that the linearised model expects to remain.
struct ScreenedModel {
  StrutModel model;
  double training_gain = 0.0;              ///< expected decrease of the (robust) training sum of squares
  Residuals residuals;                     ///< expected
  FitFailure failure = FitFailure::kNone;  ///< kWrongSign: no coefficient above 0 helps; all as without it
};

/// Ranks candidates by how much of the residual their linear response (linear_response.h) explains on the training
/// samples, all coefficients of the model free to change along. Shapes are scanned over their range.
class Screening {
 public:
  /// @param fit  the present model, fitted on the training samples. The arguments must outlive this object.
  Screening(const Records& records, const HoldOut& held_out, const ModelFit& fit);

  /// @return the present model.
  const StrutModel& model() const { return response_.fit().model; }

  /// @return nothing if the effect does not act in these drives or does nothing that the model cannot do already.
  std::optional<ScreenedModel> screen(const ForceEffect& effect) const;
  std::optional<ScreenedModel> screen(const MeasurementEffect& effect) const;

  /// @return a model as it is, by its own free run instead of an expectation; nothing if it runs away.
  std::optional<ScreenedModel> asItIs(const StrutModel& model) const;

  /// What a free-form force over travel and travel rate could take of the held-out error: piecewise bilinear on a grid,
  /// fitted on the training samples.
  /// @return 1 - after / before, of the held-out sum of squares; 0 if it only harms.
  double surfaceGain() const;

 private:
  ScreenedModel expect(const WeightedProjection::Columns& columns, const WeightedProjection::Part& part) const;
  StrutModel changed(const Eigen::VectorXd& common) const;

  const Records& records_;
  LinearResponse response_;
  WeightedProjection rows_;  // of measured - predicted by the responses to b1, b0 and the present effects' coefficients
};

/// @return shapes of the effect in SI, spread evenly in ratio over their ranges: at most 64 combinations, one (empty)
/// for an effect without shapes.
std::vector<std::vector<double>> scanShapes(const ForceEffect& effect, const MotionScale& scales);

}  // namespace suspension_health_monitor
