#pragma once

#include <Eigen/Core>
#include <vector>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"

namespace suspension_health_monitor {

/// A motion over segments that follow one another.
struct SegmentedMotion {
  std::vector<StrutMotion> samples;    ///< without memory
  std::vector<std::size_t> begins{0};  ///< of the segments, and the end of the last one
  std::vector<double> rests;           ///< [s], rests[i] between segment i and the next; empty: unknown
};

/// @return rms of travel and travel rate, and the natural time of a strut.
MotionScale scaleOf(const SegmentedMotion& motion, double stiffness_to_mass);

/// The force of an effect, per unit of its coefficient, at every sample of a motion; the memory starts at 0 in every
/// segment, or with what lasts.
Eigen::VectorXd forceAlong(const ForceEffect& effect, const std::vector<double>& shapes, const SegmentedMotion& motion);

/// What the force of a model is made of along a motion: travel rate, travel and the forces of its effects, one column
/// for each of b1, b0 and the coefficients.
Eigen::MatrixXd forcesAlong(const StrutModel& model, const SegmentedMotion& motion);

/// What a small additional force would do to a free run: the model linearised along the motion that a fit gave it.
///   x'' = -(F_d x + F_v x' + f),   change of z'' = F_d x + F_v x' + f, behind the filter of the drive, if it has one,
/// x the change of travel, F_d and F_v the slopes of the model's force there, f the additional force per unit mass.
/// A few operations per sample instead of a nonlinear fit: for screening many candidates.
///
/// Samples of all segments of all records stand in one row, in the order of ModelFit::residuals.
class LinearResponse {
 public:
  /// @param records  must outlive this object.  @param fit  a fit of them that did not run away.
  LinearResponse(const Records& records, const ModelFit& fit);

  Eigen::Index numSamples() const { return motion_.samples.size(); }
  const SegmentedMotion& motion() const { return motion_; }
  const MotionScale& scale() const { return scale_; }

  /// @return change of z'' at every sample for an additional force `f` [m/s^2].
  Eigen::VectorXd respond(const Eigen::VectorXd& force) const;

  /// @return change of the predicted reading per unit of a measurement effect's coefficients, one column each; 0 where
  /// the effect cannot show.
  Eigen::MatrixXd readingSlopes(const MeasurementEffect& effect) const;

 private:
  double period_;
  MotionScale scale_;
  SegmentedMotion motion_;
  std::vector<double> predicted_;
  std::vector<double> slope_travel_, slope_rate_;  // F_d [1/s^2], F_v [1/s]
  Segments segments_;
  ReadingSizes sizes_;  // of what is predicted
};

}  // namespace suspension_health_monitor
