#include "suspension_health_monitor/identification/ud_covariance.h"

#include <algorithm>

namespace suspension_health_monitor {

UdCovariance::UdCovariance(int size)
    : upper_(Eigen::MatrixXd::Identity(size, size)),
      diagonal_(Eigen::VectorXd::Zero(size)),
      ceiling_(Eigen::VectorXd::Zero(size)),
      gain_(Eigen::VectorXd::Zero(size)) {}

void UdCovariance::release(int i, double variance) {
  diagonal_[i] = variance;
  ceiling_[i] = variance;
}

const Eigen::VectorXd& UdCovariance::update(const Eigen::VectorXd& regressor, double noise, double forgetting_factor) {
  const Eigen::Index p = diagonal_.size();
  double alpha = noise;
  for (Eigen::Index j = 0; j < p; ++j) {
    double* const column = upper_.data() + j * p;  // of U; its part above the diagonal
    double f = regressor[j];                       // entry j of U' phi
    for (Eigen::Index i = 0; i < j; ++i) f += column[i] * regressor[i];
    const double v = diagonal_[j] * f;
    const double alpha_before = alpha;
    alpha += f * v;
    diagonal_[j] = std::min(diagonal_[j] * alpha_before / (alpha * forgetting_factor), ceiling_[j]);
    const double multiplier = -f / alpha_before;
    gain_[j] = v;
    for (Eigen::Index i = 0; i < j; ++i) {
      const double old = column[i];
      column[i] += multiplier * gain_[i];
      gain_[i] += old * v;
    }
  }
  const double scale = 1.0 / alpha;
  for (Eigen::Index j = 0; j < p; ++j) gain_[j] *= scale;
  return gain_;
}

void UdCovariance::scale(double factor) {
  diagonal_ *= factor;
  ceiling_ *= factor;
}

double UdCovariance::variance(int i) const {
  double sum = diagonal_[i];
  for (Eigen::Index j = i + 1; j < diagonal_.size(); ++j) sum += upper_(i, j) * upper_(i, j) * diagonal_[j];
  return sum;
}

Eigen::MatrixXd UdCovariance::matrix() const { return upper_ * diagonal_.asDiagonal() * upper_.transpose(); }

}  // namespace suspension_health_monitor
