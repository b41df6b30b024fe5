#include "suspension_health_monitor/internal/blocks/window_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suspension_health_monitor {
namespace {

constexpr int kIterations = 3;     // of weights and parameters
constexpr double kUnusual = 10.0;  // times the usual power, from which a block counts less

// Power of the residual in a band, by its expansion about the block's theta, on which it depends by b1, b0 and columns
// linearly, but for the weight 1 / A.
double powerAt(const StrutBlock::Band& band, const StrutBlock& block, const BlockVector& theta, BlockVector& step) {
  const Eigen::Index p = theta.size();
  step = theta - block.at;
  step[kBlockWheelShare] = 0.0;  // e does not depend on it
  const double power = band.moments(p, p) - 2.0 * step.dot(band.moments.col(p).head(p)) +
                       step.dot(band.moments.topLeftCorner(p, p).selfadjointView<Eigen::Upper>() * step);
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
  for (int i = 0; i < kIterations; ++i) {
    weigh(blocks, result.theta, usual);
    if (!solve(blocks, prior, result.theta)) break;
  }
  weigh(blocks, result.theta, usual);
  describe(blocks, prior, least_inflation, result);
}

// The noise's spectrum, and how much a block counts.
void WindowFit::weigh(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta,
                      const Eigen::VectorXd& usual) {
  noise_.setZero();
  share_scale_.setZero();
  double weights = 0.0;
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    double times_usual = 0.0;
    for (int i = 0; i < bands_.count(); ++i) {
      power_(b, i) = powerAt(block.bands[static_cast<std::size_t>(i)], block, theta, step_) / bands_.size(i);
      if (usual.size() > 0) times_usual += power_(b, i) / usual[i] / bands_.count();
    }
    weight_[b] = times_usual > kUnusual ? kUnusual / times_usual : 1.0;
    weights += weight_[b];
    for (int i = 0; i < bands_.count(); ++i) {
      noise_[i] += weight_[b] * power_(b, i);
      share_scale_[i] += weight_[b] * block.bands[static_cast<std::size_t>(i)].wheel_power / bands_.size(i);
    }
  }
  // Without any noise the weights would be infinite: rounding errors of the signal are some.
  const double least = std::numeric_limits<double>::epsilon() * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < bands_.count(); ++i) {
    noise_[i] = std::max(noise_[i], least * share_scale_[i]) / weights;
    share_scale_[i] = share_scale_[i] > 0.0 ? noise_[i] * weights / share_scale_[i] : 0.0;
    if (!(noise_[i] > 0.0)) noise_[i] = 1.0;  // the sensors read constants
  }
}

bool WindowFit::solve(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, BlockVector& theta) {
  const Eigen::Index p = theta.size();
  prior_information_.setZero();
  prior_information_.diagonal() = prior.stddev.array().square().inverse();
  normal_ = prior_information_;
  right_ = prior_information_ * prior.mean;
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      const double weight = weight_[b] / noise_[i];
      scale_.setOnes();
      scale_[kBlockWheelShare] = share_scale_[i];
      inverse_.noalias() = weight * (scale_.asDiagonal() * band.information * scale_.asDiagonal());
      normal_ += inverse_;
      right_.noalias() += inverse_ * block.at;
      right_ += weight * scale_.cwiseProduct(band.score);
    }
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
  if (!solve(blocks, prior, ignored)) {
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
  const double now = blocks.back()->end;
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      body += weight_[b] * band.body_power;
      unexplained += weight_[b] * powerAt(band, block, linear, step_);
      rate += weight_[b] * band.rate_power;
      const Eigen::Vector2d own = weight_[b] / noise_[i] * band.information.diagonal().head<2>();
      information += own;
      age += own * (now - block.end);
    }
    weights += weight_[b];
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
  normal_ *= power * weight_.head(blocks_).sum();
  size_.setZero();
  size_.head<2>() = result.theta.head<2>();
  for (int m = 0; m < columns_.neighbours; ++m) size_[columns_.firstNeighbour() + m] = result.theta[m % 2];
  prior_information_.noalias() = inverse_ * normal_;
  normal_.noalias() = prior_information_ * size_.asDiagonal();
  for (const int i : {kBlockDamping, kBlockStiffness})
    result.alike = std::max(result.alike, normal_.row(i).norm() / result.theta[i]);
  result.covariance.noalias() += normal_ * normal_.transpose();
}

// The score of a cell at theta, by its expansion about the block's, into right_.
void WindowFit::takeScore(const StrutBlock& block, int b, int i, const BlockVector& theta) {
  const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
  step_ = theta - block.at;
  step_[kBlockWheelShare] *= share_scale_[i];
  right_ = weight_[b] / noise_[i] * (band.score - band.information * step_);
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
          weight_[b] / noise_[i] * block.bands[static_cast<std::size_t>(i)].information.topLeftCorner<2, 2>();
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
