#include "suspension_health_monitor/internal/blocks/window_fit.h"

#include <limits>

namespace suspension_health_monitor {

bool WindowEstimate::isUsable() const {
  return theta.allFinite() && covariance.allFinite() && theta[kBlockDamping] > 0.0 && theta[kBlockStiffness] > 0.0 &&
         covariance(0, 0) > 0.0 && covariance.topLeftCorner<2, 2>().determinant() > 0.0;
}

WindowFit::WindowFit(const BlockBand& band, const BlockColumns& columns, int most_blocks)
    : length_(band.length), bands_(band), columns_(columns) {
  const int p = columns.numParameters();
  power_.setZero(bands_.count(), most_blocks);
  weight_.setOnes(most_blocks);
  present_ = weight_;
  versions_.assign(most_blocks, 0);
  sums_.assign(bands_.count(), StrutBlock::Band(p));
  weights_.noise.setOnes(bands_.count());
  weights_.share_scale = weights_.noise;
  normal_.setZero(p, p);
  spread_ = normal_;
  right_.setZero(p);
  previous_.setZero(2, bands_.count());
  distances_.reserve(most_blocks);
  own_.reserve(distances_.capacity());
  own_covariance_.reserve(distances_.capacity());
}

void WindowFit::fit(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, const BlockVector& start,
                    const BandVector& median, double least_inflation, WindowEstimate& result, bool is_near) {
  blocks_ = static_cast<int>(blocks.size());
  weights_.median = median;
  result.blocks = blocks_;
  result.theta = start;
  solved_ = start.head<2>();
  gather(blocks);
  if (is_near && weigh(blocks, start)) gather(blocks);
  for (int w = 0; w < kBlockTuning.weightings; ++w) {
    for (int i = 0; i < kBlockTuning.weightings; ++i) {
      measureNoise(result.theta);
      sum(prior);
      const BlockVector solution = solvedNormal(normal_, right_).second;
      if (!solution.allFinite()) break;
      const Eigen::Vector2d before = result.theta.head<2>();
      result.theta = solution;
      solved_ = result.theta.head<2>();
      for (const int n : {kBlockDamping, kBlockStiffness})  // within a factor of two, so that the model stays stable
        result.theta[n] = std::clamp(solved_[n], 0.5 * before[n], 2.0 * before[n]);
      result.theta[kBlockWheelShare] =
          std::clamp(result.theta[kBlockWheelShare], kBlockTuning.least_share, 1.0 - kBlockTuning.least_share);
    }
    if (!weigh(blocks, result.theta)) break;
    gather(blocks);
  }
  measureNoise(result.theta);
  describe(blocks, prior, least_inflation, result);
}

// Sums over the newest blocks: those of a smaller window before this one are there already.
void WindowFit::gather(const std::vector<const StrutBlock*>& blocks) {
  const auto newest = [&](int i) -> const StrutBlock& { return *blocks[blocks_ - 1 - i]; };
  bool is_known = gathered_ <= blocks_;
  for (int i = 0; is_known && i < gathered_; ++i) is_known = versions_[i] == newest(i).version;
  if (!is_known) {
    gathered_ = 0;
    weight_.setOnes();
  }
  if (gathered_ == 0) {
    sum_of_weights_ = 0.0;
    for (StrutBlock::Band& each : sums_) each.setZero();
  }
  for (; gathered_ < blocks_; ++gathered_) {
    versions_[gathered_] = newest(gathered_).version;
    sum_of_weights_ += weight_[gathered_];
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].add(weight_[gathered_], newest(gathered_).bands[i]);
  }
}

// How much each block counts.
// @return true if that has changed: the sums have to be gathered anew.
bool WindowFit::weigh(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta) {
  for (int b = 0; b < blocks_; ++b) {
    power_.col(b) = residualPowers(*blocks[b], bands_, theta).array();
    present_[blocks_ - 1 - b] = weights_.of(power_.col(b));
  }
  auto present = present_.head(blocks_), weight = weight_.head(blocks_);
  present /= present.maxCoeff();  // where all are noisy that is the noise
  const bool has_changed = (present != weight).any();
  weight = present;
  if (has_changed) gathered_ = 0;
  return has_changed;
}

// The noise's spectrum.
void WindowFit::measureNoise(const BlockVector& theta) {
  BandVector &noise = weights_.noise, &scale = weights_.share_scale;
  // Without any noise the weights would be infinite: rounding errors of the signal are some.
  const double least = std::numeric_limits<double>::epsilon() * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < bands_.count(); ++i) {
    const StrutBlock::Band& sum = sums_[i];
    const double wheel = sum.powers[StrutBlock::Band::kWheel] / bands_.size(i),
                 power = residualPower(sum.moments, theta) / bands_.size(i);
    // From so many degrees of freedom the power is known to 1 +- sqrt(2 / degrees) only: by that weights are worse than
    // the best ones, and their inverse is too large on average, each by 2 / degrees of the variance.
    const double degrees = sum_of_weights_ * bands_.size(i) / kBinCorrelation;
    noise[i] = (1.0 + 4.0 / degrees) * std::max(power, least * wheel) / sum_of_weights_;
    scale[i] = wheel > 0.0 ? noise[i] * sum_of_weights_ / wheel : 0.0;
    if (!(noise[i] > 0.0)) noise[i] = 1.0;  // the sensors read constants
  }
}

void WindowFit::sum(const BlockPrior& prior) {
  spread_.setZero();
  normal_.setZero();
  normal_.diagonal() = prior.stddev.cwiseAbs2().cwiseInverse();
  right_ = normal_.diagonal().cwiseProduct(prior.mean);
  for (int i = 0; i < bands_.count(); ++i) {
    const StrutBlock::Band& sum = sums_[i];
    const double noise = weights_.noise[i], scale = weights_.share_scale[i];
    BlockVector score = (sum.score + scale * sum.share) / noise;
    score[kBlockWheelShare] *= scale;
    normal_ += withShare(sum.information, scale) / noise;
    spread_ += withShare(sum.instruments, scale) / noise;
    right_ += score;
  }
}

void WindowFit::describe(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, double least_inflation,
                         WindowEstimate& result) {
  sum(prior);
  const auto [inverse, solution] = solvedNormal(normal_, right_);
  result.covariance = covarianceByNoise(spread_, inverse, prior, blocks_);
  if (!solution.allFinite()) result.covariance.setConstant(std::numeric_limits<double>::infinity());
  result.inflation = std::max(least_inflation, inflation(blocks, result, inverse, prior));
  result.covariance *= result.inflation;
  result.is_settled =
      ((solved_ - result.theta.head<2>()).array().square() <= result.covariance.diagonal().head<2>().array()).all();
  result.noise = weights_.noise;
  result.alike = 0.0;
  if (!wheel_noise_.empty()) widenByAlike(inverse, result);

  using Band = StrutBlock::Band;
  Band::Powers powers = Band::Powers::Zero();
  double unexplained = 0.0;
  Eigen::Vector2d age = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 4> of_quarter = Eigen::Matrix<double, 2, 4>::Zero();
  for (const Band& each : sums_) {
    unexplained += residualPower(each.moments, result.theta);
    powers += each.powers;
  }
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[b];
    const double weight = weight_[blocks_ - 1 - b];
    for (int i = 0; i < bands_.count(); ++i) {
      const Eigen::Vector2d own = weight / weights_.noise[i] * block.bands[i].information.diagonal().head<2>();
      of_quarter.col(4 * b / blocks_) += own;
      age += own * (blocks.back()->end - block.end);
    }
  }
  const Eigen::Vector2d information = of_quarter.rowwise().sum();
  result.explained = powers[Band::kBody] > 0.0 ? 1.0 - unexplained / powers[Band::kBody] : 0.0;
  result.amplified = powers[Band::kBody] / powers[Band::kMoving];
  result.setMotion(powers / sum_of_weights_, length_);
  result.age = (age.array() / information.array()).maxCoeff();
  const int i = result.relativeStddev(kBlockDamping) > result.relativeStddev(kBlockStiffness) ? 0 : 1;
  result.roughest = 4.0 * of_quarter.row(i).maxCoeff() / information[i];
}

void WindowFit::widenByAlike(const BlockMatrix& inverse, WindowEstimate& result) {
  BlockMatrix information = BlockMatrix::Zero(inverse.rows(), inverse.cols());
  double power = std::numeric_limits<double>::infinity();
  for (int i = 0; i < bands_.count(); ++i) {
    const WheelNoise& noise = wheel_noise_[i];
    information += noise.information / weights_.noise[i];
    power = std::min(power, weights_.noise[i] / (1.0 + noise.output));
  }
  BlockVector size = BlockVector::Zero(inverse.rows());
  size.head<2>() = result.theta.head<2>();
  for (int m = 0; m < columns_.neighbours; ++m) size[columns_.firstNeighbour() + m] = result.theta[m % 2];
  BlockMatrix drawn = inverse * information;
  drawn *= power * sum_of_weights_ * size.asDiagonal();
  for (const int i : {kBlockDamping, kBlockStiffness})
    result.alike = std::max(result.alike, drawn.row(i).norm() / result.theta[i]);
  result.covariance.noalias() += drawn * drawn.transpose();
}

// The mean over b1 and b0 of how much more the estimate varies by the scatter of cells, and of neighbouring blocks
// together, than by their noise.
double WindowFit::inflation(const std::vector<const StrutBlock*>& blocks, const WindowEstimate& result,
                            const BlockMatrix& inverse, const BlockPrior& prior) {
  Eigen::Matrix2d scattered =
      inverse.topRows<2>() * prior.stddev.cwiseAbs2().cwiseInverse().asDiagonal() * inverse.topRows<2>().transpose();
  previous_.setZero();
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[b];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[i];
      const Eigen::Vector2d moved = weight_[blocks_ - 1 - b] / weights_.noise[i] * inverse.topRows<2>() *
                                    scoreOf(band, result.theta, weights_.share_scale[i]);
      const Eigen::Matrix2d with_previous = 0.5 * moved * previous_.col(i).transpose();
      scattered += moved * moved.transpose() + with_previous + with_previous.transpose();
      previous_.col(i) = moved;
    }
  }
  const Eigen::Matrix2d covariance = result.covariance.topLeftCorner<2, 2>();
  if (!(covariance.determinant() > 0.0)) return std::numeric_limits<double>::infinity();
  return 0.5 * (covariance.inverse() * scattered).trace();
}

bool WindowFit::gainsDiffer(const WindowEstimate& estimate) const {
  double spread = 0.0;  // by which gamma of one band alone differs, beyond its noise
  for (int i = 0; columns_.neighbours == 0 && i < bands_.count(); ++i) {
    const double own = sums_[i].information(kBlockGain, kBlockGain);
    const double off = scoreOf(sums_[i], estimate.theta, weights_.share_scale[i])[kBlockGain] / own;
    spread = std::max(spread, std::abs(off) - kLikely * std::sqrt(kBinCorrelation * weights_.noise[i] / own));
  }
  const double by_chance = kCertain * std::sqrt(estimate.covariance(kBlockGain, kBlockGain));
  return std::abs(estimate.theta[kBlockGain]) >= kLeastDifference + by_chance + spread / kMajority;
}

double WindowFit::scatterBetweenBlocks(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta) {
  own_.clear();
  own_covariance_.clear();
  distances_.clear();
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[b];
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d score = Eigen::Vector2d::Zero();
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[i];
      const double weight = weight_[blocks_ - 1 - b] / weights_.noise[i];
      information += weight * band.information.topLeftCorner<2, 2>();
      score += weight * scoreOf(band, theta, weights_.share_scale[i]).head<2>();
    }
    if (!(information.determinant() > 0.0)) continue;
    own_covariance_.push_back(information.inverse());
    own_.push_back(own_covariance_.back() * score);
  }
  for (std::size_t b = 2; b < own_.size(); ++b) {
    const Eigen::Vector2d apart = own_[b] - own_[b - 2];
    const Eigen::Matrix2d covariance = kBinCorrelation * (own_covariance_[b] + own_covariance_[b - 2]);
    distances_.push_back(apart.dot(covariance.inverse() * apart));
  }
  if (distances_.size() < 5) return 1.0;
  // Of chi square of two degrees of freedom the median is 2 ln 2, and that of n values varies by 1 / (ln 2 sqrt(n)) of
  // itself; neighbours share a block, so that n counts as n / 1.5. Only what is more than that is no chance.
  const double chance = std::sqrt(1.5 / static_cast<double>(distances_.size())) / std::log(2.0);
  return std::max(1.0, medianInPlace(distances_) / (2.0 * std::log(2.0) * (1.0 + chance)));
}

}  // namespace suspension_health_monitor
