#include "suspension_health_monitor/internal/vehicle/coupled_tops.h"

namespace suspension_health_monitor {

CoupledTops::CoupledTops(const BlockBand& band, std::size_t struts, std::size_t forces)
    : modulation_(band), s_(modulation_.s()), lu_(static_cast<Eigen::Index>(struts)) {
  const auto n = static_cast<Eigen::Index>(struts), m = static_cast<Eigen::Index>(forces);
  rows_ = {Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, m)};
  wheels_.setZero(s_.size(), n);
  travel_ = wheels_;
  forces_.setZero(s_.size(), m);
}

void CoupledTops::predict(const std::vector<const StrutBlock*>& blocks, int first_force) {
  const auto n = wheels_.cols();
  for (Eigen::Index j = 0; j < n; ++j)
    modulation_.apply(0, blocks[static_cast<std::size_t>(j)]->wheel, wheels_.col(j));
  for (Eigen::Index k = 0; k < forces_.cols(); ++k)
    modulation_.apply(2, blocks.front()->forces.col(first_force + k), forces_.col(k));
  Small q(n, n);
  SmallVector right(n), x(n);
  for (Eigen::Index b = 0; b < s_.size(); ++b) {
    // (s^2 I + Q) (X - Z) = s^2 X - s^2 c F
    q = rows_.rate * s_[b] + rows_.travel.cast<std::complex<double>>();
    q.diagonal().array() += s_[b] * s_[b];
    x = wheels_.row(b).matrix().transpose();
    right = s_[b] * s_[b] * x;
    if (forces_.cols() > 0) right -= rows_.force * forces_.row(b).matrix().transpose();
    lu_.compute(q);
    travel_.row(b) = lu_.solve(right).array().transpose();
  }
}

}  // namespace suspension_health_monitor
