#include "parameterization.h"

#include <cmath>

namespace suspension_health_monitor {

int Parameterization::size() const {
  int count = 2;
  for (const ActiveEffect& active : start_.effects) count += 1 + static_cast<int>(active.shapes.size());
  for (const ActiveMeasurementEffect& reading : start_.reading) count += static_cast<int>(reading.coefficients.size());
  return count;
}

Eigen::VectorXd Parameterization::initial() const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size());
  x[0] = x[1] = 1.0;
  int i = 2;
  for (std::size_t j = 0; j < start_.effects.size(); ++j) {
    x[i] = start_.effects[j].coefficient / coefficient_scales_[j];
    i += 1 + static_cast<int>(start_.effects[j].shapes.size());
  }
  std::size_t scale = start_.effects.size();
  for (const ActiveMeasurementEffect& reading : start_.reading)
    for (const double coefficient : reading.coefficients) x[i++] = coefficient / coefficient_scales_[scale++];
  return x;
}

void Parameterization::apply(const double* x, StrutModel& model) const {
  model.damping_to_mass = x[0] * start_.damping_to_mass;
  model.stiffness_to_mass = x[1] * start_.stiffness_to_mass;
  int i = 2;
  for (std::size_t j = 0; j < start_.effects.size(); ++j) {
    model.effects[j].coefficient = x[i++] * coefficient_scales_[j];
    for (std::size_t s = 0; s < start_.effects[j].shapes.size(); ++s)
      model.effects[j].shapes[s] = start_.effects[j].shapes[s] * std::exp(x[i++]);
  }
  std::size_t scale = start_.effects.size();
  for (ActiveMeasurementEffect& reading : model.reading)
    for (double& coefficient : reading.coefficients) coefficient = x[i++] * coefficient_scales_[scale++];
}

Eigen::VectorXd Parameterization::slopes(const double* x) const {
  StrutModel model = start_;
  apply(x, model);
  Eigen::VectorXd slope(size());
  slope[0] = start_.damping_to_mass;
  slope[1] = start_.stiffness_to_mass;
  int i = 2;
  for (std::size_t j = 0; j < model.effects.size(); ++j) {
    slope[i++] = coefficient_scales_[j];
    for (const double shape : model.effects[j].shapes) slope[i++] = shape;
  }
  for (std::size_t scale = start_.effects.size(); scale < coefficient_scales_.size(); ++scale)
    slope[i++] = coefficient_scales_[scale];
  return slope;
}

}  // namespace suspension_health_monitor
