#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"

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
  /// How columns explain the residual beside the model's own ones.
  struct Projection {
    double gain = 0.0;  // of the training sum of squares
    Eigen::VectorXd coefficients;
    Eigen::VectorXd common;  // changes of b1, b0 and the effects' coefficients that go along
  };

  using Columns = Eigen::Ref<const Eigen::MatrixXd>;
  std::optional<Projection> project(const Columns& columns) const;
  ScreenedModel expect(const Columns& columns, const Projection& projection) const;
  StrutModel changed(const Eigen::VectorXd& common) const;

  const Records& records_;
  LinearResponse response_;
  Eigen::VectorXd residual_;  // measured - predicted
  Eigen::VectorXd weight_;    // of a sample in training; 0: held out
  Eigen::MatrixXd common_;    // responses to b1, b0 and the present effects' coefficients
  Eigen::LLT<Eigen::MatrixXd> gram_;
  Eigen::VectorXd own_;  // what the model's own columns still explain
};

}  // namespace suspension_health_monitor
