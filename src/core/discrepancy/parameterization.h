#pragma once

#include <Eigen/Core>
#include <vector>

#include "suspension_health_monitor/discrepancy/motion_scale.h"
#include "suspension_health_monitor/model/strut_model.h"

namespace suspension_health_monitor {

/// A model as a vector of numbers of order 1: b1 and b0 relative to their start, coefficients relative to a force of
/// the size of the linear one, shapes by their place in their range (logistic in the logarithm): beyond its range many
/// a law turns into another one that the model has already, and a fit would lose its way there. Order: b1, b0,
/// coefficient and shapes effect by effect, then the reading's coefficients.
class Parameterization {
 public:
  /// @param coefficient_scales  of the effects, then of the reading's [unit of the coefficient].
  /// @param motion  what the shapes' ranges are counted in; ranges are widened to hold the start.
  Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales, const MotionScale& motion);

  int size() const;

  /// @return the start as a vector.
  Eigen::VectorXd initial() const;

  /// @param model  its numbers are replaced; it has the effects of the start.
  void apply(const double* x, StrutModel& model) const;

  /// @return d(SI value)/dx at x.
  Eigen::VectorXd slopes(const double* x) const;

 private:
  /// ln shape = lower + width / (1 + exp(-x)).
  struct Range {
    double lower, width;
  };

  StrutModel start_;
  std::vector<double> coefficient_scales_;
  std::vector<std::vector<Range>> ranges_;  // by effect and shape
};

}  // namespace suspension_health_monitor
