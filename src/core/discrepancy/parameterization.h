#pragma once

#include <Eigen/Core>
#include <vector>

#include "suspension_health_monitor/model/strut_model.h"

namespace suspension_health_monitor {

/// A model as a vector of numbers of order 1: b1 and b0 relative to their start, coefficients relative to a force of the
/// size of the linear one, shapes by the logarithm of their ratio to the start.
/// Order: b1, b0, coefficient and shapes effect by effect, then the reading's coefficients.
class Parameterization {
 public:
  /// @param coefficient_scales  of the effects, then of the reading's [unit of the coefficient].
  Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales)
      : start_(start), coefficient_scales_(coefficient_scales) {}

  int size() const;

  /// @return the start as a vector.
  Eigen::VectorXd initial() const;

  /// @param model  its numbers are replaced; it has the effects of the start.
  void apply(const double* x, StrutModel& model) const;

  /// @return d(SI value)/dx at x.
  Eigen::VectorXd slopes(const double* x) const;

 private:
  StrutModel start_;
  std::vector<double> coefficient_scales_;
};

}  // namespace suspension_health_monitor
