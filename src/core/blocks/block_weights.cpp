#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/blocks/window_fit.h"

namespace suspension_health_monitor {
namespace {

constexpr double kUnusual = 10.0;  // times the usual power, from which a block counts less

BlockVector stepFrom(const StrutBlock& block, const BlockVector& theta) { return theta - block.at; }

}  // namespace

double BlockWeights::of(const StrutBlock& block, const NoiseBands& bands, const BlockVector& theta) const {
  if (usual.size() == 0) return 1.0;
  double times = 0.0;
  for (int i = 0; i < bands.count(); ++i)
    times += residualPower(block.bands[static_cast<std::size_t>(i)], block, theta) / (bands.size(i) * usual[i]);
  const double beyond = kUnusual * bands.count() / times;
  return beyond < 1.0 ? beyond * beyond : 1.0;
}

double residualPower(const StrutBlock::Band& band, const StrutBlock& block, const BlockVector& theta) {
  const Eigen::Index p = theta.size();
  BlockVector step = stepFrom(block, theta);
  step[kBlockWheelShare] = 0.0;  // e does not depend on it
  double power = band.moments(p, p);
  for (Eigen::Index j = 0; j < p; ++j)
    power += step[j] * (band.moments.col(j).head(p).dot(step) - 2.0 * band.moments(j, p));
  return std::max(power, 0.0);
}

BlockVector scoreOf(const StrutBlock::Band& band, const StrutBlock& block, const BlockVector& theta,
                    double share_scale) {
  BlockVector step = stepFrom(block, theta);
  step[kBlockWheelShare] *= share_scale;
  BlockVector score = band.score - band.information * step;
  score[kBlockWheelShare] *= share_scale;
  return score;
}

BlockMatrix informationOf(const StrutBlock::Band& band, double share_scale) {
  BlockMatrix information = band.information;
  information.row(kBlockWheelShare) *= share_scale;
  information.col(kBlockWheelShare) *= share_scale;
  return information;
}

NormalEquations::NormalEquations(const BlockMatrix& normal, const BlockVector& right)
    : inverse(normal), solution(right) {
  // A column that is silent, such as that of an end stop which is not reached, leaves its parameter at 0, unknown.
  constexpr double kNoInformation = 1e-200;
  const BlockVector information = normal.diagonal().cwiseAbs().cwiseMax(kNoInformation);
  const BlockVector scale = information.cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return;
  BlockMatrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  for (Eigen::Index i = 0; i < scaled.rows(); ++i)
    if (normal(i, i) == 0.0) scaled(i, i) = 1.0;
  inverse = Eigen::PartialPivLU<BlockMatrix>(scaled).inverse();
  inverse = scale.asDiagonal() * inverse * scale.asDiagonal();
  solution.noalias() = inverse * right;
  is_solvable = solution.allFinite();
}

BlockMatrix covarianceByNoise(const BlockMatrix& normal, const BlockMatrix& inverse, const BlockPrior& prior,
                              int blocks) {
  const double correlation = WindowFit::kBinCorrelation + WindowFit::kBlockCorrelation * (blocks - 1.0) / blocks;
  BlockMatrix middle = correlation * normal;
  middle.diagonal() += (1.0 - correlation) * prior.stddev.cwiseAbs2().cwiseInverse();
  BlockMatrix covariance = inverse * middle * inverse.transpose();
  middle = covariance.transpose();
  covariance = 0.5 * (covariance + middle);
  return covariance;
}

BlockVector linearPart(const BlockVector& theta, const BlockColumns& columns) {
  BlockVector linear = theta;
  linear.segment(columns.firstForce(), columns.forces).setZero();
  return linear;
}

}  // namespace suspension_health_monitor
