// What BlockEstimator knows from all blocks: of parameters that change slowly, and over the drive.
#include <algorithm>
#include <cmath>
#include <limits>

#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"

namespace suspension_health_monitor {
namespace {

bool isSlow(int i) { return i == kBlockDelay || i == kBlockGain || i >= kNumBlockParameters; }

}  // namespace

// Of the prior. A strut that bounces far faster than a car's has shorter blocks, and a delay that is shorter by as
// much.
double BlockEstimator::delayStddev() const {
  return std::min(1.0, equations_.band().length / kBlockTuning.length) * kBlockTuning.delay_stddev;
}

// A gain, and of a vehicle a delay, is let in only if it is more than links and laws with memory make, see
// kBlockTuning.least_phase.
void BlockEstimator::lookAtSensors() {
  const bool is_alone = equations_.columns().neighbours == 0;
  const double omega = equations_.band().omega(equations_.band().last);
  if (!is_alone) first_.stddev[kBlockDelay] = kBlockTuning.delay_stddev;
  first_.stddev[kBlockGain] = kBlockTuning.gain_stddev;
  const bool is_known = fit(count_, first_, trial_, true);
  if (!is_alone && (!is_known || std::abs(trial_.theta[kBlockDelay]) * omega < kBlockTuning.least_phase))
    first_.stddev[kBlockDelay] = kBlockTuning.held;
  const bool tells_gain = is_known && trial_.explained >= kBlockTuning.nearly_all;
  const bool differ = window_fit_.gainsDiffer(trial_);
  if (tells_gain && !differ) first_.mean[kBlockGain] = 0.0;
  if (!tells_gain || !differ) first_.stddev[kBlockGain] = kBlockTuning.held;
}

void BlockEstimator::forgetSlow() {
  slow_ = first_;
  of_all_.reset();
}

void BlockEstimator::scaleSlow(int parameter, double factor, double stddev) {
  factor_[parameter] = factor;
  factor_stddev_[parameter] = stddev;
}

void BlockEstimator::scaleSlow() {
  scaled_.mean = slow_.mean.cwiseProduct(factor_);
  scaled_.stddev =
      (slow_.stddev.cwiseProduct(factor_).array().square() + slow_.mean.cwiseProduct(factor_stddev_).array().square())
          .sqrt();
}

void BlockEstimator::learnSlow() {
  lookAtSensors();
  if (!fit(count_, first_, trial_, true)) return;
  slow_ = first_;
  for (int i = 0; i < static_cast<int>(theta_.size()); ++i) {
    if (!isSlow(i)) continue;
    slow_.mean[i] = trial_.theta[i];
    slow_.stddev[i] = std::min(kBlockTuning.slow_factor * std::sqrt(trial_.covariance(i, i)), first_.stddev[i]);
  }
  const auto& power = window_fit_.power();
  weights_ = window_fit_.weights();
  weights_.median.resize(power.rows());
  for (Eigen::Index i = 0; i < power.rows(); ++i) {
    sorted_.resize(power.cols());
    Eigen::VectorXd::Map(sorted_.data(), power.cols()) = power.row(i);
    weights_.median[i] = std::max(medianInPlace(sorted_), std::numeric_limits<double>::min());
  }
  scatter_ = window_fit_.scatterBetweenBlocks(newest(count_), trial_.theta);
  of_all_ = trial_;
}

bool BlockEstimator::contradictsSlow() {
  if (weights_.median.size() == 0) return false;
  BlockPrior open = scaled_;
  open.stddev = first_.stddev;
  if (!fit(kBlockWindows.front(), open, trial_)) return false;
  for (int i = 0; i < static_cast<int>(theta_.size()); ++i) {
    if (!isSlow(i) || !std::isfinite(scaled_.stddev[i])) continue;
    const double apart = std::abs(trial_.theta[i] - scaled_.mean[i]);
    if (apart > kProven * std::sqrt(trial_.covariance(i, i) + scaled_.stddev[i] * scaled_.stddev[i])) return true;
  }
  return false;
}

// Blocks that were never linearised, since no strut was known then, tell nothing.
void BlockEstimator::retire(const StrutBlock& block) {
  if (weights_.median.size() > 0 && block.at[kBlockStiffness] > 0.0) drive_.add(block, weights_, block.at);
}

void BlockEstimator::retireAll() {
  if (count_ > 0 && has_theta_ && weights_.median.size() == 0 && fit(count_, first_, trial_)) {
    weights_ = window_fit_.weights();
    weights_.median = weights_.noise;
  }
  for (int age = count_ - 1; age >= 0; --age) retire(block(age));
  count_ = 0;
}

void BlockEstimator::restart() {
  retireAll();
  weights_.median = BandVector();
  scatter_ = 1.0;
  first_.mean[kBlockGain] = 0.0;
  slow_ = scaled_ = first_;
  has_theta_ = false;
  updates_ = 0;
}

std::optional<WindowEstimate> BlockEstimator::overTheDrive() {
  constexpr int kMostSteps = 30;
  constexpr double kStill = 1e-12;  // relative
  const auto ofDriveFit = [this] {
    BlockEstimator copy = *this;
    copy.retireAll();
    return copy.drive_.estimate(first_);
  };
  if (drive_.blocks() > 0) return ofDriveFit();
  if (!hasBlocks() || !(has_theta_ || start())) return std::nullopt;
  if (of_all_ && weights_.median.size() > 0) theta_ = of_all_->theta;  // the newest strut may be another one
  WindowEstimate result;
  for (int i = 0; i < kMostSteps; ++i) {
    const BlockVector before = theta_;
    for (int age = 0; age < count_; ++age) equations_.linearise(theta_, block(age));
    if (!fit(count_, first_, result, true)) return std::nullopt;
    theta_ = result.theta;
    if (((theta_ - before).array().abs() <= kStill * theta_.array().abs()).head<2>().all()) break;
  }
  if (const auto of_drive = ofDriveFit()) result.change = of_drive->change;
  return result;
}

}  // namespace suspension_health_monitor
