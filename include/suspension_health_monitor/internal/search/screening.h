#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"

namespace suspension_health_monitor {

/// Weighted least squares of a target by the columns that a model has, and what more columns would take of the rest.
class WeightedProjection {
 public:
  using Columns = Eigen::Ref<const Eigen::MatrixXd>;

  /// How columns explain the target beside the model's own ones.
  struct Part {
    double gain = 0.0;             ///< of the weighted sum of squares
    Eigen::VectorXd coefficients;  ///< of the columns
    Eigen::VectorXd common;        ///< of the model's own ones, which go along
  };

  WeightedProjection() = default;

  /// @param common  the model's own columns, (n, p).  @param weight  of a row, 0: it does not count, (n).
  /// @param target  (n).
  WeightedProjection(Eigen::MatrixXd common, Eigen::VectorXd weight, Eigen::VectorXd target);

  /// @return nothing if a column is one that the model's own make already, or is 0 where it counts.
  std::optional<Part> project(const Columns& columns) const;

  /// @return what the model's own columns leave of the weighted sum of squares.
  double unexplained() const { return weight_.dot(target_.cwiseAbs2()) - own_.dot(gram_.solve(own_)); }

  const Eigen::MatrixXd& common() const { return common_; }
  const Eigen::VectorXd& weight() const { return weight_; }
  const Eigen::VectorXd& target() const { return target_; }

 private:
  Eigen::MatrixXd common_;
  Eigen::VectorXd weight_, target_;
  Eigen::LLT<Eigen::MatrixXd> gram_;
  Eigen::VectorXd own_;  // what the model's own columns have in common with the target
};

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
  ScreenedModel expect(const WeightedProjection::Columns& columns, const WeightedProjection::Part& part) const;

  const Records& records_;
  const ModelFit& fit_;
  LinearResponse response_;
  WeightedProjection rows_;  // of measured - predicted by the responses to b1, b0 and the present effects' coefficients
};

/// @return shapes of the effect in SI, spread evenly in ratio over their ranges: at most 36 combinations, one (empty)
/// for an effect without shapes.
std::vector<std::vector<double>> scanShapes(const ForceEffect& effect, const MotionScale& scales);

}  // namespace suspension_health_monitor
