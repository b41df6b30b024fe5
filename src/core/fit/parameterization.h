#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"

namespace suspension_health_monitor {

// In the logarithm, between a start and the end of a range that is widened for it.
inline constexpr double kRangeMargin = 0.02;

inline double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

/// A model as a vector of numbers of order 1, in the order of valuesOf(): b1 and b0 relative to their start,
/// coefficients relative to a force of the size of the linear one, shapes by their place in their range (logistic in
/// the logarithm): beyond its range many a law turns into another one that the model has already, and a fit would lose
/// its way there.
class Parameterization {
 public:
  /// @param coefficient_scales  of the effects, then of the reading's [unit of the coefficient].
  /// @param motion  what the shapes' ranges are counted in; ranges are widened to hold the start.
  Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales, const MotionScale& motion)
      : start_(start), motion_(motion) {
    numbers_ = {{start.damping_to_mass}, {start.stiffness_to_mass}};
    std::vector<double> x{1.0, 1.0};
    auto scale = coefficient_scales.begin();
    for (const auto& [effect, coefficient, shapes] : start.effects) {
      numbers_.push_back({*scale});
      x.push_back(coefficient / *scale++);
      for (std::size_t s = 0; s < shapes.size(); ++s) {
        const ShapeParameter& shape = effect.shapes[s];
        const double at = std::log(shapes[s]), unit = std::log(motion.unit(shape.scale));
        const double lower = std::min(std::log(shape.min) + unit, at - kRangeMargin);
        const double width = std::max(std::log(shape.max) + unit, at + kRangeMargin) - lower;
        const double place = (at - lower) / width;
        numbers_.push_back({0.0, lower, width});
        x.push_back(std::log(place / (1.0 - place)));
      }
    }
    for (const ActiveMeasurementEffect& reading : start.reading)
      for (const double coefficient : reading.coefficients) {
        numbers_.push_back({*scale});
        x.push_back(coefficient / *scale++);
      }
    initial_ = Eigen::Map<const Eigen::VectorXd>(x.data(), size());
  }

  int size() const { return static_cast<int>(numbers_.size()); }

  /// @return the start as a vector.
  const Eigen::VectorXd& initial() const { return initial_; }

  const MotionScale& motion() const { return motion_; }

  StrutModel model(const double* x) const {
    StrutModel model = start_;
    auto number = numbers_.begin();
    for (double* value : valuesOf(model)) *value = number++->value(*x++);
    return model;
  }

  /// @return d(SI value)/dx at x.
  Eigen::VectorXd slopes(const double* x) const {
    Eigen::VectorXd slope(size());
    for (int i = 0; i < size(); ++i) slope[i] = numbers_[i].slope(x[i]);
    return slope;
  }

 private:
  /// value = scale x; of a shape ln value = lower + width / (1 + exp(-x)), width > 0.
  struct Number {
    double scale = 0.0, lower = 0.0, width = 0.0;

    bool isShape() const { return width > 0.0; }
    double value(double x) const { return isShape() ? std::exp(lower + width * logistic(x)) : scale * x; }
    double slope(double x) const { return isShape() ? value(x) * width * logistic(x) * (1.0 - logistic(x)) : scale; }
  };

  StrutModel start_;
  MotionScale motion_;
  std::vector<Number> numbers_;
  Eigen::VectorXd initial_;
};

}  // namespace suspension_health_monitor
