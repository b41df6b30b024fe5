#include "suspension_health_monitor/internal/identification/ud_covariance.h"

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
  double alpha = noise;
  for (Eigen::Index j = 0; j < diagonal_.size(); ++j) {
    auto column = upper_.col(j);
    const double f = regressor[j] + column.head(j).dot(regressor.head(j));  // entry j of U' phi
    const double v = diagonal_[j] * f, alpha_before = alpha;
    alpha += f * v;
    diagonal_[j] = std::min(diagonal_[j] * alpha_before / (alpha * forgetting_factor), ceiling_[j]);
    gain_[j] = v;
    for (Eigen::Index i = 0; i < j; ++i) {
      const double before = column[i];
      column[i] -= f / alpha_before * gain_[i];
      gain_[i] += before * v;
    }
  }
  gain_ /= alpha;
  return gain_;
}

void UdCovariance::scale(double factor) {
  diagonal_ *= factor;
  ceiling_ *= factor;
}

Eigen::MatrixXd UdCovariance::matrix() const { return upper_ * diagonal_.asDiagonal() * upper_.transpose(); }

}  // namespace suspension_health_monitor
