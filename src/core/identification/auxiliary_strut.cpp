#include "suspension_health_monitor/internal/identification/auxiliary_strut.h"

#include <cmath>

namespace suspension_health_monitor {

void AuxiliaryStrut::setModel(double stiffness_to_mass) {
  frequency_ = std::sqrt(stiffness_to_mass);
  // With x = (v, sqrt(b0) d): x' = w0 (-1 -1; 1 0) x, of which the exponential is known in closed form.
  const double root = std::sqrt(3.0) / 2.0, angle = root * frequency_ * period_;
  const double sine = std::sin(angle) / root;
  transition_ << std::cos(angle) - sine / 2, -sine, sine, std::cos(angle) + sine / 2;
  transition_ *= std::exp(-frequency_ * period_ / 2);
}

void AuxiliaryStrut::push(double acceleration) {
  const Eigen::Vector2d rest(0.0, (acceleration + last_) / 2);
  forces_ = transition_ * (forces_ - rest) + rest;
  last_ = acceleration;
}

}  // namespace suspension_health_monitor
