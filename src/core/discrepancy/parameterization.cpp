#include "parameterization.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

Parameterization::Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales,
                                   const MotionScale& motion)
    : start_(start), coefficient_scales_(coefficient_scales) {
  constexpr double margin = 0.02;  // between a start and the end of a range that is widened for it
  for (const ActiveEffect& active : start.effects) {
    ranges_.emplace_back();
    for (std::size_t s = 0; s < active.shapes.size(); ++s) {
      const ShapeParameter& shape = active.effect.shapes[s];
      const double at = std::log(active.shapes[s]), scale = std::log(motion.unit(shape.scale));
      const double lower = std::min(std::log(shape.min) + scale, at - margin);
      const double upper = std::max(std::log(shape.max) + scale, at + margin);
      ranges_.back().push_back({lower, upper - lower});
    }
  }
}

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
    x[i++] = start_.effects[j].coefficient / coefficient_scales_[j];
    for (std::size_t s = 0; s < ranges_[j].size(); ++s) {
      const double place = (std::log(start_.effects[j].shapes[s]) - ranges_[j][s].lower) / ranges_[j][s].width;
      x[i++] = std::log(place / (1.0 - place));
    }
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
    for (std::size_t s = 0; s < ranges_[j].size(); ++s)
      model.effects[j].shapes[s] = std::exp(ranges_[j][s].lower + ranges_[j][s].width / (1.0 + std::exp(-x[i++])));
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
    for (std::size_t s = 0; s < ranges_[j].size(); ++s, ++i) {
      const double place = 1.0 / (1.0 + std::exp(-x[i]));
      slope[i] = model.effects[j].shapes[s] * ranges_[j][s].width * place * (1.0 - place);
    }
  }
  for (std::size_t j = 0; j < start_.reading.size(); ++j) slope[i++] = readingScale(j);
  return slope;
}

}  // namespace suspension_health_monitor
