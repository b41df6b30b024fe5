#include <algorithm>

#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"

namespace suspension_health_monitor {

double BlockWeights::of(const Eigen::Ref<const Eigen::ArrayXd>& power) const {
  if (usual.size() == 0) return 1.0;
  const double times = timesUsual(power);
  return times > kBlockTuning.full ? kBlockTuning.full * kBlockTuning.full / (times * times) : 1.0;
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

BandVector residualPowers(const StrutBlock& block, const NoiseBands& bands, const BlockVector& theta) {
  BandVector powers(bands.count());
  for (int i = 0; i < bands.count(); ++i) powers[i] = residualPower(block.bands[i].moments, theta) / bands.size(i);
  return powers;
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

DriveFit::DriveFit(const BlockBand& band, const BlockColumns& columns)
    : length_(band.length), bands_(band), columns_(columns) {
  const Eigen::Index p = columns.numParameters();
  information_.setZero(p, p);
  scatter_ = spread_ = information_;
  right_.setZero(p);
  previous_.assign(bands_.count(), right_);
}

void DriveFit::add(const StrutBlock& block, const BlockWeights& weights, const BlockVector& theta) {
  ++blocks_;
  const double weight = weights.of(residualPowers(block, bands_, theta).array());
  weight_ += weight;
  for (int i = 0; i < bands_.count(); ++i) {
    const StrutBlock::Band& band = block.bands[i];
    const double scale = weights.share_scale[i], of_band = weight / weights.noise[i];
    const BlockMatrix information = of_band * withShare(band.information, scale);
    const BlockVector score = of_band * scoreOf(band, theta, scale);
    information_ += information;
    spread_ += of_band * withShare(band.instruments, scale);
    right_.noalias() += information * theta;
    right_ += score;
    BlockVector& previous = previous_[i];
    const BlockMatrix with_previous = 0.5 * score * previous.transpose();
    scatter_ += score * score.transpose() + with_previous + with_previous.transpose();
    previous = score;
    body_ += weight * band.body_power;
    unexplained_ += weight * residualPower(band.moments, theta);
    rate_ += weight * band.rate_power;
    travel_ += weight * band.travel_power;
  }
}

std::optional<WindowEstimate> DriveFit::estimate(const BlockPrior& prior) const {
  if (blocks_ < kBlockWindows.front()) return std::nullopt;
  BlockMatrix normal = information_;
  BlockVector right = right_;
  const BlockVector known = prior.stddev.cwiseAbs2().cwiseInverse();
  normal.diagonal() += known;
  right += known.cwiseProduct(prior.mean);
  const NormalEquations equations(normal, right);
  if (!equations.is_solvable) return std::nullopt;
  WindowEstimate result;
  result.blocks = blocks_;
  result.theta = equations.solution;
  result.covariance = covarianceByNoise(spread_, equations.inverse, prior, blocks_);
  BlockMatrix scattered = scatter_;
  scattered.diagonal() += known;
  scattered = equations.inverse * scattered * equations.inverse.transpose();
  const Eigen::Matrix2d covariance = result.covariance.topLeftCorner<2, 2>();
  result.inflation = std::max(1.0, 0.5 * (covariance.inverse() * scattered.topLeftCorner<2, 2>()).trace());
  result.covariance *= result.inflation;
  result.explained = body_ > 0.0 ? 1.0 - unexplained_ / body_ : 0.0;
  result.setMotion(rate_ / weight_, travel_ / weight_, length_);
  if (!result.isUsable()) return std::nullopt;
  return result;
}

}  // namespace suspension_health_monitor
