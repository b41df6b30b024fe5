#include "suspension_health_monitor/internal/blocks/drive_fit.h"

#include <algorithm>

namespace suspension_health_monitor {

DriveFit::DriveFit(const BlockBand& band, const BlockColumns& columns)
    : length_(band.length), bands_(band), columns_(columns) {
  const Eigen::Index p = columns.numParameters();
  information_.setZero(p, p);
  scatter_ = spread_ = information_;
  right_.setZero(p);
  previous_.assign(static_cast<std::size_t>(bands_.count()), right_);
}

void DriveFit::add(const StrutBlock& block, const BlockWeights& weights, const BlockVector& theta) {
  ++blocks_;
  const double weight = weights.of(block, bands_, theta);
  weight_ += weight;
  for (int i = 0; i < bands_.count(); ++i) {
    const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
    const double scale = weights.share_scale[i], of_band = weight / weights.noise[i];
    const BlockMatrix information = of_band * withShare(band.information, scale);
    const BlockVector score = of_band * scoreOf(band, theta, scale);
    information_ += information;
    spread_ += of_band * withShare(band.instruments, scale);
    right_.noalias() += information * theta;
    right_ += score;
    BlockVector& previous = previous_[static_cast<std::size_t>(i)];
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
  if (blocks_ < kFewestBlocks) return std::nullopt;
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
