#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/blocks/window_fit.h"

namespace suspension_health_monitor {
namespace {

constexpr double kFull = 10.0;  // times the usual power, up to which a block counts in full

}  // namespace

double BlockWeights::of(const Eigen::Ref<const Eigen::ArrayXd>& power) const {
  if (usual.size() == 0) return 1.0;
  const double times = timesUsual(power);
  return times > kFull ? kFull * kFull / (times * times) : 1.0;
}

double BlockWeights::of(const StrutBlock& block, const NoiseBands& bands, const BlockVector& theta) const {
  BandVector power(bands.count());
  for (int i = 0; i < bands.count(); ++i)
    power[i] = residualPower(block.bands[static_cast<std::size_t>(i)].moments, theta) / bands.size(i);
  return of(power.array());
}

double residualPower(const Eigen::MatrixXd& moments, const BlockVector& theta) {
  const Eigen::Index p = theta.size();
  BlockVector linear = theta;
  linear[kBlockWheelShare] = 0.0;  // e does not depend on it
  double power = moments(p, p) - 2.0 * moments.col(p).head(p).dot(linear);
  for (Eigen::Index j = 0; j < p; ++j)
    power += linear[j] * (linear[j] * moments(j, j) + 2.0 * moments.col(j).head(j).dot(linear.head(j)));
  return std::max(power, 0.0);
}

BlockVector scoreOf(const StrutBlock::Band& band, const BlockVector& theta, double share_scale) {
  BlockVector scaled = theta;
  scaled[kBlockWheelShare] *= share_scale;
  BlockVector score = band.score + share_scale * band.share - band.information.lazyProduct(scaled);
  score[kBlockWheelShare] *= share_scale;
  return score;
}

BlockMatrix withShare(const Eigen::MatrixXd& products, double share_scale) {
  BlockMatrix scaled = products;
  scaled.row(kBlockWheelShare) *= share_scale;
  scaled.col(kBlockWheelShare) *= share_scale;
  return scaled;
}

NormalEquations::NormalEquations(const BlockMatrix& normal, const BlockVector& right)
    : inverse(normal), solution(right) {
  // A column that is silent, such as that of an end stop which is not reached, leaves its parameter at 0, unknown.
  constexpr double kNoInformation = 1e-200;
  const BlockVector scale = normal.diagonal().cwiseAbs().cwiseMax(kNoInformation).cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return;
  BlockMatrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  for (Eigen::Index i = 0; i < scaled.rows(); ++i)
    if (normal(i, i) == 0.0) scaled(i, i) = 1.0;
  inverse = Eigen::PartialPivLU<BlockMatrix>(scaled).inverse();
  inverse = scale.asDiagonal() * inverse * scale.asDiagonal();
  solution.noalias() = inverse * right;
  is_solvable = solution.allFinite();
}

BlockMatrix covarianceByNoise(const BlockMatrix& instruments, const BlockMatrix& inverse, const BlockPrior& prior,
                              int blocks) {
  const double correlation = WindowFit::kBinCorrelation + WindowFit::kBlockCorrelation * (blocks - 1.0) / blocks;
  BlockMatrix middle = correlation * instruments;
  middle.diagonal() += prior.stddev.cwiseAbs2().cwiseInverse();
  return inverse * middle * inverse.transpose();
}

}  // namespace suspension_health_monitor
