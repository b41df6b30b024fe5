#pragma once

#include <Eigen/Core>
#include <vector>

#include "suspension_health_monitor/internal/record/motion_scale.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// A model as a vector of numbers of order 1, in the order of valuesOf(): b1 and b0 relative to their start,
/// coefficients relative to a force of the size of the linear one, shapes by their place in their range (logistic in
/// the logarithm): beyond its range many a law turns into another one that the model has already, and a fit would lose
/// its way there.
class Parameterization {
 public:
  /// @param coefficient_scales  of the effects, then of the reading's [unit of the coefficient].
  /// @param motion  what the shapes' ranges are counted in; ranges are widened to hold the start.
  Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales, const MotionScale& motion);

  int size() const { return static_cast<int>(numbers_.size()); }

  /// @return the start as a vector.
  const Eigen::VectorXd& initial() const { return initial_; }

  /// @param model  its numbers are replaced; it has the effects of the start.
  void apply(const double* x, StrutModel& model) const;

  /// @return d(SI value)/dx at x.
  Eigen::VectorXd slopes(const double* x) const;

 private:
  /// value = scale x; of a shape ln value = lower + width / (1 + exp(-x)), width > 0.
  struct Number {
    double scale = 0.0, lower = 0.0, width = 0.0;

    bool isShape() const { return width > 0.0; }
    double value(double x) const;
    double slope(double x) const;
  };

  std::vector<Number> numbers_;
  Eigen::VectorXd initial_;
};

}  // namespace suspension_health_monitor
