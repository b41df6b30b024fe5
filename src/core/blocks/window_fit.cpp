#include "suspension_health_monitor/internal/blocks/window_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suspension_health_monitor {
namespace {

constexpr int kIterations = 3;     // of the noise and parameters
constexpr int kWeighings = 3;      // of blocks
constexpr double kSameWeight = 0.1;
constexpr double kUnusual = 10.0;  // times the usual power, from which a block counts less

// Power of the residual in a band, or in a sum of bands; it does not depend on r. e is linear in the parameters but for
// the weight 1 / A.
double powerAt(const Eigen::MatrixXd& moments, const BlockVector& theta, BlockVector& linear) {
  const Eigen::Index p = theta.size();
  linear = theta;
  linear[kBlockWheelShare] = 0.0;
  double power = moments(p, p) - 2.0 * moments.col(p).head(p).dot(linear);
  for (Eigen::Index i = 0; i < p; ++i)
    power += linear[i] * (linear[i] * moments(i, i) + 2.0 * moments.col(i).head(i).dot(linear.head(i)));
  return std::max(power, 0.0);
}

}  // namespace

bool WindowEstimate::isUsable() const {
  return theta.allFinite() && covariance.allFinite() && theta[kBlockDamping] > 0.0 && theta[kBlockStiffness] > 0.0 &&
         covariance(0, 0) > 0.0 && covariance.topLeftCorner<2, 2>().determinant() > 0.0;
}

WindowFit::WindowFit(const NoiseBands& bands, const BlockColumns& columns, int most_blocks)
    : bands_(bands), columns_(columns) {
  const Eigen::Index p = columns.numParameters();
  sums_.resize(static_cast<std::size_t>(bands.count()));
  for (Sum& each : sums_) {
    each.information.setZero(p, p);
    each.moments.setZero(p + 1, p + 1);
    each.score.setZero(p);
    each.share.setZero(p);
  }
  power_.setZero(most_blocks, bands.count());
  weight_.setOnes(most_blocks);
  noise_.setOnes(bands.count());
  share_scale_ = noise_;
  for (BlockMatrix* each : {&normal_, &inverse_, &prior_information_}) each->setZero(p, p);
  for (BlockVector* each : {&right_, &step_, &scale_, &size_}) each->setZero(p);
  previous_.setZero(2, bands.count());
  lu_ = Eigen::PartialPivLU<BlockMatrix>(p);
  medians_.reserve(static_cast<std::size_t>(most_blocks));
  own_.reserve(medians_.capacity());
  own_covariance_.reserve(medians_.capacity());
}

void WindowFit::fit(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, const BlockVector& start,
                    const Eigen::VectorXd& usual, double least_inflation, WindowEstimate& result) {
  blocks_ = static_cast<int>(blocks.size());
  result.blocks = blocks_;
  result.theta = start;
  gather(blocks);
  for (int i = 0; i < kWeighings; ++i) {
    for (int k = 0; k < kIterations; ++k) {
      measureNoise(result.theta);
      if (!solve(prior, result.theta)) break;
    }
    if (!weigh(blocks, result.theta, usual)) break;
    gathered_ = 0;
    gather(blocks);
  }
  measureNoise(result.theta);
  describe(blocks, prior, least_inflation, result);
}

void WindowFit::newBlocks() {
  gathered_ = 0;
  weight_.setOnes();
}

// Sums over the newest blocks; those of a smaller window before this one are there already.
void WindowFit::gather(const std::vector<const StrutBlock*>& blocks) {
  if (gathered_ > blocks_) gathered_ = 0;
  if (gathered_ == 0) {
    weights_ = 0.0;
    for (Sum& each : sums_) each.setZero();
  }
  for (; gathered_ < blocks_; ++gathered_) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(blocks_ - 1 - gathered_)];
    const double weight = weight_[gathered_];
    weights_ += weight;
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].add(weight, block.bands[i]);
  }
}

void WindowFit::Sum::setZero() {
  information.setZero();
  moments.setZero();
  score.setZero();
  share.setZero();
  wheel_power = 0.0;
}

void WindowFit::Sum::add(double weight, const StrutBlock::Band& band) {
  information.noalias() += weight * band.information;
  moments.noalias() += weight * band.moments;
  score += weight * band.score;
  share += weight * band.share;
  wheel_power += weight * band.wheel_power;
}

// How much each block counts.
// @return true if that has changed.
bool WindowFit::weigh(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta,
                      const Eigen::VectorXd& usual) {
  bool has_changed = false;
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    double times_usual = 0.0;
    for (int i = 0; i < bands_.count(); ++i) {
      power_(b, i) = powerAt(block.bands[static_cast<std::size_t>(i)].moments, theta, step_) / bands_.size(i);
      if (usual.size() > 0) times_usual += power_(b, i) / usual[i] / bands_.count();
    }
    double& weight = weight_[blocks_ - 1 - b];
    const double now = times_usual > kUnusual ? kUnusual / times_usual : 1.0;
    has_changed = has_changed || std::abs(now - weight) > kSameWeight * weight;
    weight = now;
  }
  return has_changed;
}

// The noise's spectrum.
void WindowFit::measureNoise(const BlockVector& theta) {
  // Without any noise the weights would be infinite: rounding errors of the signal are some.
  const double least = std::numeric_limits<double>::epsilon() * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < bands_.count(); ++i) {
    const Sum& sum = sums_[static_cast<std::size_t>(i)];
    const double wheel = sum.wheel_power / bands_.size(i);
    noise_[i] = std::max(powerAt(sum.moments, theta, step_) / bands_.size(i), least * wheel) / weights_;
    share_scale_[i] = wheel > 0.0 ? noise_[i] * weights_ / wheel : 0.0;
    if (!(noise_[i] > 0.0)) noise_[i] = 1.0;  // the sensors read constants
  }
}

bool WindowFit::solve(const BlockPrior& prior, BlockVector& theta) {
  const Eigen::Index p = theta.size();
  prior_information_.setZero();
  prior_information_.diagonal() = prior.stddev.array().square().inverse();
  normal_ = prior_information_;
  right_ = prior_information_ * prior.mean;
  for (int i = 0; i < bands_.count(); ++i) {
    const Sum& sum = sums_[static_cast<std::size_t>(i)];
    inverse_ = sum.information / noise_[i];
    step_ = (sum.score + share_scale_[i] * sum.share) / noise_[i];
    inverse_.col(kBlockWheelShare) *= share_scale_[i];
    inverse_.row(kBlockWheelShare) *= share_scale_[i];
    step_[kBlockWheelShare] *= share_scale_[i];
    normal_ += inverse_;
    right_ += step_;
  }
  // Units differ by orders of magnitude.
  scale_ = normal_.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  if (!scale_.allFinite()) return false;
  inverse_.noalias() = scale_.asDiagonal() * normal_ * scale_.asDiagonal();
  lu_.compute(inverse_);
  step_ = scale_.cwiseProduct(lu_.solve(scale_.cwiseProduct(right_)));
  if (!step_.allFinite()) return false;
  for (Eigen::Index i = 0; i < p; ++i) {
    if (i == kBlockDamping || i == kBlockStiffness)
      theta[i] = std::clamp(step_[i], 0.5 * theta[i], 2.0 * theta[i]);
    else if (i == kBlockWheelShare)
      theta[i] = std::clamp(step_[i], 0.02, 0.98);
    else
      theta[i] = step_[i];
  }
  return true;
}

void WindowFit::describe(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, double least_inflation,
                         WindowEstimate& result) {
  BlockVector ignored = result.theta;
  if (!solve(prior, ignored)) {
    result.covariance.setConstant(result.theta.size(), result.theta.size(), std::numeric_limits<double>::infinity());
    return;
  }
  // normal_ is now at the final weights.
  inverse_ = lu_.inverse();
  inverse_ = scale_.asDiagonal() * inverse_ * scale_.asDiagonal();
  const double correlation = kBinCorrelation + kBlockCorrelation * (blocks_ - 1.0) / blocks_;
  result.covariance.noalias() =
      inverse_ * (correlation * (normal_ - prior_information_) + prior_information_) * inverse_.transpose();
  result.covariance = 0.5 * (result.covariance + result.covariance.transpose()).eval();
  result.inflation =
      std::max(least_inflation, inflation(blocks, result.theta, result.covariance.topLeftCorner<2, 2>()));
  result.covariance *= result.inflation;
  result.noise = noise_;
  result.alike = 0.0;
  if (!wheel_noise_.empty()) widenByAlike(result);

  double body = 0.0, unexplained = 0.0, rate = 0.0, weights = 0.0;
  Eigen::Vector2d age = Eigen::Vector2d::Zero(), information = age;
  BlockVector& linear = ignored;  // the strut without the columns
  linear = result.theta;
  linear.tail(columns_.forces + columns_.neighbours).head(columns_.forces).setZero();
  for (const Sum& sum : sums_) unexplained += powerAt(sum.moments, linear, step_);
  const double now = blocks.back()->end;
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    const double weight = weight_[blocks_ - 1 - b];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      body += weight * band.body_power;
      rate += weight * band.rate_power;
      const Eigen::Vector2d own = weight / noise_[i] * band.information.diagonal().head<2>();
      information += own;
      age += own * (now - block.end);
    }
    weights += weight;
  }
  result.explained = body > 0.0 ? 1.0 - unexplained / body : 0.0;
  // Parseval: the mean square over a block is 2 sum |H|^2 / (T^2 mean(hann^2)), and mean(hann^2) = 3/8; T^2 by the
  // user.
  result.rate = std::sqrt(2.0 * rate / weights / 0.375);
  result.age = (age.array() / information.array()).maxCoeff();
}

void WindowFit::widenByAlike(WindowEstimate& result) {
  normal_.setZero();
  double power = std::numeric_limits<double>::infinity();
  for (int i = 0; i < bands_.count(); ++i) {
    const WheelNoise& noise = wheel_noise_[static_cast<std::size_t>(i)];
    normal_ += noise.information / noise_[i];
    power = std::min(power, noise_[i] / (1.0 + noise.output));
  }
  normal_ *= power * weights_;
  size_.setZero();
  size_.head<2>() = result.theta.head<2>();
  for (int m = 0; m < columns_.neighbours; ++m) size_[columns_.firstNeighbour() + m] = result.theta[m % 2];
  prior_information_.noalias() = inverse_ * normal_;
  normal_.noalias() = prior_information_ * size_.asDiagonal();
  for (const int i : {kBlockDamping, kBlockStiffness})
    result.alike = std::max(result.alike, normal_.row(i).norm() / result.theta[i]);
  result.covariance.noalias() += normal_ * normal_.transpose();
}

// The score of a cell at theta into right_.
void WindowFit::takeScore(const StrutBlock& block, int b, int i, const BlockVector& theta) {
  const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
  step_ = theta;
  step_[kBlockWheelShare] *= share_scale_[i];
  right_ = band.score + share_scale_[i] * band.share - band.information.lazyProduct(step_);
  right_ *= weight_[blocks_ - 1 - b] / noise_[i];
  right_[kBlockWheelShare] *= share_scale_[i];
}

// The mean over b1 and b0 of how much more the estimate varies by the scatter of cells, and of neighbouring blocks
// together, than by their noise.
double WindowFit::inflation(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta,
                            const Eigen::Matrix2d& covariance) {
  Eigen::Matrix2d scattered = (inverse_ * prior_information_ * inverse_.transpose()).topLeftCorner<2, 2>();
  previous_.setZero();
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    for (int i = 0; i < bands_.count(); ++i) {
      takeScore(block, b, i, theta);
      const Eigen::Vector2d moved = inverse_.topRows<2>() * right_;
      const Eigen::Matrix2d with_previous = 0.5 * moved * previous_.col(i).transpose();
      scattered += moved * moved.transpose() + with_previous + with_previous.transpose();
      previous_.col(i) = moved;
    }
  }
  const double determinant = covariance.determinant();
  if (!(determinant > 0.0)) return std::numeric_limits<double>::infinity();
  return 0.5 * (covariance.inverse() * scattered).trace();
}

double WindowFit::scatterBetweenBlocks(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta) {
  own_.clear();
  own_covariance_.clear();
  medians_.clear();
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d score = Eigen::Vector2d::Zero();
    for (int i = 0; i < bands_.count(); ++i) {
      takeScore(block, b, i, theta);
      score += right_.head<2>();
      information +=
          weight_[blocks_ - 1 - b] / noise_[i] * block.bands[static_cast<std::size_t>(i)].information.topLeftCorner<2, 2>();
    }
    if (!(information.determinant() > 0.0)) continue;
    own_covariance_.push_back(information.inverse());
    own_.push_back(own_covariance_.back() * score);
  }
  for (std::size_t b = 2; b < own_.size(); ++b) {
    const Eigen::Vector2d apart = own_[b] - own_[b - 2];
    const Eigen::Matrix2d covariance = kBinCorrelation * (own_covariance_[b] + own_covariance_[b - 2]);
    medians_.push_back(apart.dot(covariance.inverse() * apart));
  }
  if (medians_.size() < 5) return 1.0;
  const auto middle = medians_.begin() + static_cast<std::ptrdiff_t>(medians_.size() / 2);
  std::nth_element(medians_.begin(), middle, medians_.end());
  constexpr double kMedianOfChiSquare = 1.386;  // 2 ln 2, of two degrees of freedom
  return std::max(1.0, *middle / kMedianOfChiSquare);
}

}  // namespace suspension_health_monitor
