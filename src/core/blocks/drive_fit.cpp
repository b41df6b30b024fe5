#include <algorithm>
#include <limits>

#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

double BlockWeights::of(const Eigen::Ref<const Eigen::ArrayXd>& power) const {
  if (median.size() == 0) return 1.0;
  const double times = overMedian(power);
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

std::pair<BlockMatrix, BlockVector> solvedNormal(const BlockMatrix& normal, const BlockVector& right) {
  std::pair<BlockMatrix, BlockVector> result(normal, right);
  auto& [inverse, solution] = result;
  // A column that is silent, such as that of an end stop which is not reached, leaves its parameter at 0, unknown.
  constexpr double kNoInformation = 1e-200;
  const BlockVector scale = normal.diagonal().cwiseAbs().cwiseMax(kNoInformation).cwiseSqrt().cwiseInverse();
  solution.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (!scale.allFinite()) return result;
  BlockMatrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  for (Eigen::Index i = 0; i < scaled.rows(); ++i)
    if (normal(i, i) == 0.0) scaled(i, i) = 1.0;
  inverse = Eigen::PartialPivLU<BlockMatrix>(scaled).inverse();
  inverse = scale.asDiagonal() * inverse * scale.asDiagonal();
  solution.noalias() = inverse * right;
  return result;
}

BlockMatrix covarianceByNoise(const BlockMatrix& instruments, const BlockMatrix& inverse, const BlockPrior& prior,
                              int blocks) {
  const double correlation = WindowFit::kBinCorrelation + WindowFit::kBlockCorrelation * (blocks - 1.0) / blocks;
  BlockMatrix middle = correlation * instruments;
  middle.diagonal() += prior.stddev.cwiseAbs2().cwiseInverse();
  return inverse * middle * inverse.transpose();
}

DriveFit::Sums DriveFit::Sums::operator-(const Sums& other) const {
  return {
      blocks - other.blocks, information - other.information, spread - other.spread,           scatter - other.scatter,
      right - other.right,   powers - other.powers,           unexplained - other.unexplained, weight - other.weight};
}

DriveFit::DriveFit(const BlockBand& band, const BlockColumns& columns)
    : length_(band.length), bands_(band), columns_(columns) {
  const Eigen::Index p = columns.numParameters();
  all_.information.setZero(p, p);
  all_.scatter = all_.spread = all_.information;
  all_.right.setZero(p);
  before_.assign(kMostInstants, all_);
  previous_.assign(bands_.count(), all_.right);
}

void DriveFit::add(const StrutBlock& block, const BlockWeights& weights, const BlockVector& theta) {
  const double weight = weights.of(residualPowers(block, bands_, theta).array());
  all_.weight += weight;
  for (int i = 0; i < bands_.count(); ++i) {
    const StrutBlock::Band& band = block.bands[i];
    const double scale = weights.share_scale[i], of_band = weight / weights.noise[i];
    const BlockMatrix information = of_band * withShare(band.information, scale);
    const BlockVector score = of_band * scoreOf(band, theta, scale);
    all_.information += information;
    all_.spread += of_band * withShare(band.instruments, scale);
    all_.right.noalias() += information * theta;
    all_.right += score;
    BlockVector& previous = previous_[i];
    const BlockMatrix with_previous = 0.5 * score * previous.transpose();
    all_.scatter += score * score.transpose() + with_previous + with_previous.transpose();
    previous = score;
    all_.powers += weight * band.powers;
    all_.unexplained += weight * residualPower(band.moments, theta);
  }
  if (++all_.blocks % blocks_between_ != 0) return;
  if (num_instants_ == kMostInstants) {
    for (std::size_t i = 1; 2 * i < kMostInstants; ++i) std::swap(before_[i], before_[2 * i]);
    num_instants_ /= 2;
    blocks_between_ *= 2;
  }
  before_[num_instants_++] = all_;
}

std::optional<WindowEstimate> DriveFit::estimate(const Sums& sums, const BlockPrior& prior) const {
  if (sums.blocks < kBlockWindows.front()) return std::nullopt;
  BlockMatrix normal = sums.information;
  BlockVector right = sums.right;
  const BlockVector known = prior.stddev.cwiseAbs2().cwiseInverse();
  normal.diagonal() += known;
  right += known.cwiseProduct(prior.mean);
  const auto [inverse, solution] = solvedNormal(normal, right);
  if (!solution.allFinite()) return std::nullopt;
  WindowEstimate result;
  result.blocks = sums.blocks;
  result.theta = solution;
  result.covariance = covarianceByNoise(sums.spread, inverse, prior, sums.blocks);
  BlockMatrix scattered = sums.scatter;
  scattered.diagonal() += known;
  scattered = inverse * scattered * inverse.transpose();
  const Eigen::Matrix2d covariance = result.covariance.topLeftCorner<2, 2>();
  result.inflation = std::max(1.0, 0.5 * (covariance.inverse() * scattered.topLeftCorner<2, 2>()).trace());
  result.covariance *= result.inflation;
  const double body = sums.powers[StrutBlock::Band::kBody];
  result.explained = body > 0.0 ? 1.0 - sums.unexplained / body : 0.0;
  result.setMotion(sums.powers / sums.weight, length_);
  if (!result.isUsable()) return std::nullopt;
  return result;
}

std::optional<WindowEstimate> DriveFit::estimate(const BlockPrior& prior) const {
  std::optional<WindowEstimate> whole = estimate(all_, prior);
  if (whole) findChange(prior, *whole);
  return whole;
}

// Compares every stretch between two instants with the rest of the drive, and keeps the one that differs most: by more
// than another road makes a strut differ (kLeastChange), beyond chance.
void DriveFit::findChange(const BlockPrior& prior, WindowEstimate& whole) const {
  double most = limitFor(static_cast<double>(num_instants_ * (num_instants_ + 1)));  // b1 and b0 of every stretch
  const auto variance = [this](const WindowEstimate& estimate) -> Eigen::Array2d {
    const Eigen::Array2d by_noise = estimate.covariance.diagonal().head<2>();
    if (!columns_.has_friction) return by_noise;
    const DryFriction friction = estimate.dryFriction();
    return by_noise + Eigen::Array2d(friction.lawStddev(), friction.stiffnessLawStddev()).square();
  };
  for (std::size_t from = 0; from < num_instants_; ++from)
    for (std::size_t to = from + 1; to <= num_instants_; ++to) {
      const Sums within = (to < num_instants_ ? before_[to] : all_) - before_[from];
      const auto one = estimate(within, prior), other = estimate(all_ - within, prior);
      if (!one || !other) continue;
      const Eigen::Array2d rest = other->theta.head<2>(), change = one->theta.head<2>().array() - rest;
      const Eigen::Array2d deviation = (variance(*one) + variance(*other)).sqrt();
      const double beyond = ((change.abs() - kLeastChange * rest) / deviation).maxCoeff();
      if (!(beyond > most)) continue;
      most = beyond;
      const double begin = 0.5 * length_ * before_[from].blocks;
      whole.change = {begin, begin + 0.5 * length_ * within.blocks, change[0] / rest[0], change[1] / rest[1]};
    }
}

}  // namespace suspension_health_monitor
