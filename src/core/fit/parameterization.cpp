#include "parameterization.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kMargin = 0.02;  // in the logarithm, between a start and the end of a range that is widened for it

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

}  // namespace

Parameterization::Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales,
                                   const MotionScale& motion) {
  numbers_ = {{start.damping_to_mass}, {start.stiffness_to_mass}};
  std::vector<double> x{1.0, 1.0};
  auto scale = coefficient_scales.begin();
  for (const auto& [effect, coefficient, shapes] : start.effects) {
    numbers_.push_back({*scale});
    x.push_back(coefficient / *scale++);
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      const ShapeParameter& shape = effect.shapes[s];
      const double at = std::log(shapes[s]), unit = std::log(motion.unit(shape.scale));
      const double lower = std::min(std::log(shape.min) + unit, at - kMargin);
      const double width = std::max(std::log(shape.max) + unit, at + kMargin) - lower;
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

double Parameterization::Number::value(double x) const {
  return isShape() ? std::exp(lower + width * logistic(x)) : scale * x;
}

double Parameterization::Number::slope(double x) const {
  return isShape() ? value(x) * width * logistic(x) * (1.0 - logistic(x)) : scale;
}

void Parameterization::apply(const double* x, StrutModel& model) const {
  auto number = numbers_.begin();
  for (double* value : valuesOf(model)) *value = number++->value(*x++);
}

Eigen::VectorXd Parameterization::slopes(const double* x) const {
  Eigen::VectorXd slope(size());
  for (int i = 0; i < size(); ++i) slope[i] = numbers_[static_cast<std::size_t>(i)].slope(x[i]);
  return slope;
}

}  // namespace suspension_health_monitor
