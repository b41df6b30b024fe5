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

void CoupledTops::setRows(const TopRows& rows) {
  rows_ = rows;
  const auto n = wheels_.cols();
  follows_.resize(static_cast<std::size_t>(s_.size()));
  for (Eigen::Index b = 0; b < s_.size(); ++b) {
    const std::complex<double> s2 = s_[b] * s_[b];
    Small& q = follows_[static_cast<std::size_t>(b)];
    q = rows_.rate * s_[b] + rows_.travel.cast<std::complex<double>>();
    q.diagonal().array() += s2;
    lu_.compute(q);
    q = s2 * lu_.solve(Small::Identity(n, n));
  }
}

const std::vector<WheelNoise>& CoupledTops::wheelNoise(std::size_t strut, const StrutEquations& equations) {
  const NoiseBands& bands = equations.noiseBands();
  const BlockColumns& columns = equations.columns();
  const auto n = static_cast<std::size_t>(wheels_.cols());
  const auto i = static_cast<Eigen::Index>(strut);
  const double b1 = rows_.rate(i, i), b0 = rows_.travel(i, i);
  const auto columnOf = [&](std::size_t j) {
    return j == strut ? int{kBlockDamping} : columns.firstNeighbour() + neighbourColumn(strut, j);
  };
  noise_.assign(static_cast<std::size_t>(bands.count()),
                {BlockMatrix::Zero(columns.numParameters(), columns.numParameters()), 0.0});
  for (int band = 0; band < bands.count(); ++band) {
    WheelNoise& noise = noise_[static_cast<std::size_t>(band)];
    BlockMatrix& sum = noise.information;
    for (int bin = bands.first(band); bin < bands.first(band) + bands.size(band); ++bin) {
      const std::complex<double> s = s_[bin];
      const double a2 = std::norm(s * s + b1 * s + b0);
      const Small& follows = follows_[static_cast<std::size_t>(bin)];
      for (Eigen::Index j = 0; j < follows.cols(); ++j)
        noise.output += std::norm((j == i ? 1.0 : 0.0) - follows(i, j)) / bands.size(band);
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j) {
          const std::complex<double> z = std::conj(follows(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)));
          const int row = columnOf(k), column = columnOf(j);
          sum(row, column) += std::real(z) * std::norm(s) / a2;
          sum(row + 1, column + 1) += std::real(z) / a2;
          sum(row, column + 1) += std::real(z * std::conj(s)) / a2;
          sum(row + 1, column) += std::real(z * s) / a2;
        }
    }
  }
  return noise_;
}

void CoupledTops::predict(const std::vector<const StrutBlock*>& blocks, int first_force) {
  const auto n = wheels_.cols();
  for (Eigen::Index j = 0; j < n; ++j) modulation_.apply(0, blocks[static_cast<std::size_t>(j)]->wheel, wheels_.col(j));
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
