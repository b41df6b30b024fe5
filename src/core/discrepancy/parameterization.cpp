#include "parameterization.h"

#include <cmath>

namespace suspension_health_monitor {

int Parameterization::size() const {
  int count = 2;
  for (const ActiveEffect& active : start_.effects) count += 1 + static_cast<int>(active.shapes.size());
  return count + static_cast<int>(start_.reading.size());
}

Eigen::VectorXd Parameterization::initial() const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size());
  x[0] = x[1] = 1.0;
  int i = 2;
  for (std::size_t j = 0; j < start_.effects.size(); ++j) {
    x[i] = start_.effects[j].coefficient / coefficient_scales_[j];
    i += 1 + static_cast<int>(start_.effects[j].shapes.size());
  }
  for (std::size_t j = 0; j < start_.reading.size(); ++j) x[i++] = start_.reading[j].coefficient / readingScale(j);
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
  for (std::size_t j = 0; j < start_.reading.size(); ++j) model.reading[j].coefficient = x[i++] * readingScale(j);
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
  for (std::size_t j = 0; j < start_.reading.size(); ++j) slope[i++] = readingScale(j);
  return slope;
}

}  // namespace suspension_health_monitor
