#include "suspension_health_monitor/internal/blocks/window_fit.h"

#include <algorithm>
#include <limits>

namespace suspension_health_monitor {
namespace {

constexpr int kIterations = 3;         // of weights and parameters
constexpr double kContradicted = 4.0;  // standard deviations: by chance once in an hour
constexpr double kLeastShare = 0.02;   // of r and of 1 - r: at 0 and 1 the instruments know no noise of one sensor

// Within a factor of two of what it was, so that the model stays stable.
double withinReach(double value, double before) { return std::clamp(value, 0.5 * before, 2.0 * before); }

}  // namespace

bool WindowEstimate::isUsable() const {
  return theta.allFinite() && covariance.allFinite() && theta[kBlockDamping] > 0.0 && theta[kBlockStiffness] > 0.0 &&
         covariance(0, 0) > 0.0 && covariance.topLeftCorner<2, 2>().determinant() > 0.0;
}

WindowFit::WindowFit(const BlockBand& band, const BlockColumns& columns, int most_blocks)
    : length_(band.length), bands_(band), columns_(columns) {
  const Eigen::Index p = columns.numParameters();
  power_.setZero(most_blocks, bands_.count());
  weight_.setOnes(most_blocks);
  weights_.noise.setOnes(bands_.count());
  weights_.share_scale = weights_.noise;
  normal_.setZero(p, p);
  right_.setZero(p);
  previous_.setZero(2, bands_.count());
  distances_.reserve(static_cast<std::size_t>(most_blocks));
  own_.reserve(distances_.capacity());
  own_covariance_.reserve(distances_.capacity());
}

void WindowFit::fit(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, const BlockVector& start,
                    const Eigen::VectorXd& usual, double least_inflation, WindowEstimate& result) {
  blocks_ = static_cast<int>(blocks.size());
  weights_.usual = usual;
  result.blocks = blocks_;
  result.theta = start;
  for (int i = 0; i < kIterations; ++i) {
    weigh(blocks, result.theta);
    sum(blocks, prior);
    const NormalEquations equations(normal_, right_);
    if (!equations.is_solvable) break;
    const double b1 = result.theta[kBlockDamping], b0 = result.theta[kBlockStiffness];
    result.theta = equations.solution;
    result.theta[kBlockDamping] = withinReach(result.theta[kBlockDamping], b1);
    result.theta[kBlockStiffness] = withinReach(result.theta[kBlockStiffness], b0);
    result.theta[kBlockWheelShare] = std::clamp(result.theta[kBlockWheelShare], kLeastShare, 1.0 - kLeastShare);
  }
  weigh(blocks, result.theta);
  describe(blocks, prior, least_inflation, result);
}

bool WindowFit::isContradicted(const std::vector<const StrutBlock*>& blocks, int count, const BlockPrior& prior,
                               const WindowEstimate& estimate) const {
  BlockMatrix normal = BlockMatrix::Zero(normal_.rows(), normal_.cols());
  normal.diagonal() = prior.stddev.cwiseAbs2().cwiseInverse();
  BlockVector right = normal.diagonal().cwiseProduct(prior.mean - estimate.theta);
  double power = 0.0;  // of e, over that of the noise
  for (int b = blocks_ - count; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      const double weight = weight_[b] / weights_.noise[i], scale = weights_.share_scale[i];
      normal += weight * informationOf(band, scale);
      right += weight * scoreOf(band, block, estimate.theta, scale);
      power += weight_[b] * power_(b, i) / (weights_.noise[i] * count * bands_.count());
    }
  }
  const NormalEquations equations(normal, right);
  if (!equations.is_solvable) return false;
  const Eigen::Vector2d step = equations.solution.head<2>();
  const Eigen::Matrix2d covariance = std::max(1.0, power) * estimate.inflation *
                                     covarianceByNoise(normal, equations.inverse, prior, count).topLeftCorner<2, 2>();
  return step.dot(covariance.inverse() * step) > kContradicted * kContradicted;
}

// The noise's spectrum, and how much a block counts.
void WindowFit::weigh(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta) {
  Eigen::VectorXd &noise = weights_.noise, &scale = weights_.share_scale;
  noise.setZero();
  scale.setZero();
  for (int b = 0; b < blocks_; ++b) weight_[b] = weights_.of(*blocks[static_cast<std::size_t>(b)], bands_, theta);
  weight_.head(blocks_) /= weight_.head(blocks_).maxCoeff();  // where all are noisy that is the noise
  const double weights = weight_.head(blocks_).sum();
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      power_(b, i) = residualPower(band, block, theta) / bands_.size(i);
      noise[i] += weight_[b] * power_(b, i);
      scale[i] += weight_[b] * band.wheel_power / bands_.size(i);
    }
  }
  // Without any noise the weights would be infinite: rounding errors of the signal are some.
  const double least = std::numeric_limits<double>::epsilon() * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < bands_.count(); ++i) {
    // From so many degrees of freedom the power is known to 1 +- sqrt(2 / degrees) only: by that weights are worse than
    // the best ones, and their inverse is too large on average, each by 2 / degrees of the variance.
    const double degrees = weights * bands_.size(i) / kBinCorrelation;
    noise[i] = (1.0 + 4.0 / degrees) * std::max(noise[i], least * scale[i]) / weights;
    scale[i] = scale[i] > 0.0 ? noise[i] * weights / scale[i] : 0.0;
    if (!(noise[i] > 0.0)) noise[i] = 1.0;  // the sensors read constants
  }
}

void WindowFit::sum(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior) {
  normal_.setZero();
  normal_.diagonal() = prior.stddev.cwiseAbs2().cwiseInverse();
  right_ = normal_.diagonal().cwiseProduct(prior.mean);
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      const double weight = weight_[b] / weights_.noise[i], scale = weights_.share_scale[i];
      const BlockMatrix information = weight * informationOf(band, scale);
      normal_ += information;
      right_.noalias() += information * block.at;
      right_ += weight * band.score;
      right_[kBlockWheelShare] += weight * (scale - 1.0) * band.score[kBlockWheelShare];
    }
  }
}

void WindowFit::describe(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, double least_inflation,
                         WindowEstimate& result) {
  sum(blocks, prior);
  const NormalEquations equations(normal_, right_);
  result.covariance = covarianceByNoise(normal_, equations.inverse, prior, blocks_);
  if (!equations.is_solvable) result.covariance.setConstant(std::numeric_limits<double>::infinity());
  result.inflation = std::max(least_inflation, inflation(blocks, result, equations.inverse, prior));
  result.covariance *= result.inflation;
  result.noise = weights_.noise;

  double body = 0.0, unexplained = 0.0, rate = 0.0;
  Eigen::Vector2d age = Eigen::Vector2d::Zero(), information = age;
  const BlockVector linear = linearPart(result.theta, columns_);
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      body += weight_[b] * band.body_power;
      unexplained += weight_[b] * residualPower(band, block, linear);
      rate += weight_[b] * band.rate_power;
      const Eigen::Vector2d own = weight_[b] / weights_.noise[i] * band.information.diagonal().head<2>();
      information += own;
      age += own * (blocks.back()->end - block.end);
    }
  }
  result.explained = body > 0.0 ? 1.0 - unexplained / body : 0.0;
  result.setRate(rate / weight_.head(blocks_).sum(), length_);
  result.age = (age.array() / information.array()).maxCoeff();
}

// The mean over b1 and b0 of how much more the estimate varies by the scatter of cells, and of neighbouring blocks
// together, than by their noise.
double WindowFit::inflation(const std::vector<const StrutBlock*>& blocks, const WindowEstimate& result,
                            const BlockMatrix& inverse, const BlockPrior& prior) {
  Eigen::Matrix2d scattered =
      inverse.topRows<2>() * prior.stddev.cwiseAbs2().cwiseInverse().asDiagonal() * inverse.topRows<2>().transpose();
  previous_.setZero();
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      const Eigen::Vector2d moved = weight_[b] / weights_.noise[i] * inverse.topRows<2>() *
                                    scoreOf(band, block, result.theta, weights_.share_scale[i]);
      const Eigen::Matrix2d with_previous = 0.5 * moved * previous_.col(i).transpose();
      scattered += moved * moved.transpose() + with_previous + with_previous.transpose();
      previous_.col(i) = moved;
    }
  }
  const Eigen::Matrix2d covariance = result.covariance.topLeftCorner<2, 2>();
  if (!(covariance.determinant() > 0.0)) return std::numeric_limits<double>::infinity();
  return 0.5 * (covariance.inverse() * scattered).trace();
}

double WindowFit::scatterBetweenBlocks(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta) {
  own_.clear();
  own_covariance_.clear();
  distances_.clear();
  for (int b = 0; b < blocks_; ++b) {
    const StrutBlock& block = *blocks[static_cast<std::size_t>(b)];
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d score = Eigen::Vector2d::Zero();
    for (int i = 0; i < bands_.count(); ++i) {
      const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(i)];
      const double weight = weight_[b] / weights_.noise[i];
      information += weight * band.information.topLeftCorner<2, 2>();
      score += weight * scoreOf(band, block, theta, weights_.share_scale[i]).head<2>();
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
  const auto middle = distances_.begin() + static_cast<std::ptrdiff_t>(distances_.size() / 2);
  std::nth_element(distances_.begin(), middle, distances_.end());
  constexpr double kMedianOfChiSquare = 1.386;  // 2 ln 2, of two degrees of freedom
  return std::max(1.0, *middle / kMedianOfChiSquare);
}

}  // namespace suspension_health_monitor
