#include "suspension_health_monitor/identification/ud_covariance.h"

#include <algorithm>

namespace suspension_health_monitor {

UdCovariance::UdCovariance(int size)
    : upper_(Eigen::MatrixXd::Identity(size, size)),
      diagonal_(Eigen::VectorXd::Zero(size)),
      ceiling_(Eigen::VectorXd::Zero(size)),
      gain_(Eigen::VectorXd::Zero(size)) {}

// The kept rows W of U make P = W D W', which has to become triangular again: modified weighted Gram-Schmidt, Bierman,
// ch. VI.4.
UdCovariance::UdCovariance(const UdCovariance& before, const std::vector<std::optional<int>>& sources)
    : UdCovariance(static_cast<int>(sources.size())) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(size(), before.size());
  for (int i = 0; i < size(); ++i)
    if (const std::optional<int>& source = sources[static_cast<std::size_t>(i)]) {
      rows.row(i) = before.upper_.row(*source);
      ceiling_[i] = before.ceiling_[*source];
    }
  for (int j = size() - 1; j >= 0; --j) {
    const Eigen::VectorXd weighted = before.diagonal_.cwiseProduct(rows.row(j).transpose());
    diagonal_[j] = rows.row(j).dot(weighted);
    if (diagonal_[j] == 0.0) continue;
    for (int i = 0; i < j; ++i) {
      upper_(i, j) = rows.row(i).dot(weighted) / diagonal_[j];
      rows.row(i) -= upper_(i, j) * rows.row(j);
    }
  }
}

void UdCovariance::release(int i, double variance) {
  diagonal_[i] = variance;
  ceiling_[i] = variance;
}

const Eigen::VectorXd& UdCovariance::update(const Eigen::VectorXd& regressor, double noise, double forgetting_factor) {
  // Plain pointers: the compiler cannot know that writing a number does not move a vector.
  const double* const phi = regressor.data();
  const double* const ceiling = ceiling_.data();
  double* const diagonal = diagonal_.data();
  double* const gain = gain_.data();
  double* column = upper_.data();  // of U; its part above the diagonal
  withPlainSize(diagonal_.size(), [&](auto p) {
    double alpha = noise;
    for (Eigen::Index j = 0; j < p; ++j, column += p) {
      double f = phi[j];  // entry j of U' phi
      for (Eigen::Index i = 0; i < j; ++i) f += column[i] * phi[i];
      const double v = diagonal[j] * f;
      const double alpha_before = alpha;
      alpha += f * v;
      diagonal[j] = std::min(diagonal[j] * alpha_before / (alpha * forgetting_factor), ceiling[j]);
      const double multiplier = -f / alpha_before;
      gain[j] = v;
      for (Eigen::Index i = 0; i < j; ++i) {
        const double old = column[i];
        column[i] += multiplier * gain[i];
        gain[i] += old * v;
      }
    }
    const double scale = 1.0 / alpha;
    for (Eigen::Index j = 0; j < p; ++j) gain[j] *= scale;
  });
  return gain_;
}

void UdCovariance::forgetAlong(const Eigen::VectorXd& regressor, double forgetting_factor) {
  const double* const phi = regressor.data();
  const double* const ceiling = ceiling_.data();
  double* const diagonal = diagonal_.data();
  double* const rest = gain_.data();
  double* const upper = upper_.data();
  withPlainSize(diagonal_.size(), [&](auto p) {
    double information = 0.0;  // phi' P^-1 phi by U^-1 phi
    for (Eigen::Index i = 0; i < p; ++i) rest[i] = phi[i];
    for (Eigen::Index j = p - 1; j >= 0; --j) {
      if (rest[j] == 0.0 || diagonal[j] == 0.0) continue;
      information += rest[j] * rest[j] / diagonal[j];
      for (Eigen::Index i = 0; i < j; ++i) rest[i] -= rest[j] * upper[j * p + i];
    }
    if (!(information > 0.0)) return;
    double weight = (1.0 - forgetting_factor) / (forgetting_factor * information);
    for (Eigen::Index i = 0; i < p; ++i) rest[i] = phi[i];
    for (Eigen::Index j = p - 1; j >= 0; --j) {
      const double before = diagonal[j], entry = rest[j];
      if (entry == 0.0 || before == 0.0) continue;
      const double after = before + weight * entry * entry;
      for (Eigen::Index i = 0; i < j; ++i) {
        rest[i] -= entry * upper[j * p + i];
        upper[j * p + i] += weight * entry * rest[i] / after;
      }
      diagonal[j] = std::min(after, ceiling[j]);
      weight *= before / after;
    }
  });
}

void UdCovariance::scale(double factor) {
  diagonal_ *= factor;
  ceiling_ *= factor;
}

Eigen::MatrixXd UdCovariance::matrix() const { return upper_ * diagonal_.asDiagonal() * upper_.transpose(); }

}  // namespace suspension_health_monitor
