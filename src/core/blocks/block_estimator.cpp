#include "suspension_health_monitor/internal/blocks/block_estimator.h"

#include <algorithm>
#include <utility>

#include "suspension_health_monitor/internal/blocks/tuning.h"

namespace suspension_health_monitor {
namespace {

// A fit may find a strut where there is none. While the vehicle is at rest there is only noise, and p parameters
// explain p of the numbers of half overlapped blocks by chance. And where something else moves the body at one
// frequency, as the wind rocks a parked car, the body drags its wheel along as if by a strut with hardly any damper:
// then the body moves more than the resonance of a strut with a damping ratio of 0.115 would make it, or what is not
// explained of its motion has more than half of the power of the wheel's motion.
bool explainsSomething(const WindowEstimate& estimate, const BlockBand& band) {
  const double values = band.size() * (estimate.blocks + 1.0);
  const double least_explained = 2.0 * static_cast<double>(estimate.theta.size()) / values;
  return estimate.is_settled && estimate.explained > least_explained &&
         estimate.amplified < kBlockTuning.most_amplified &&
         (1.0 - estimate.explained) * estimate.amplified < kMajority;
}

// @param power  that a fit leaves of these blocks, per bin, by band and block.
// @return true if the fit explains most of what the body did in most bands.
bool explainsMostBands(const Eigen::Ref<const Eigen::ArrayXXd>& power, const std::vector<const StrutBlock*>& blocks,
                       const NoiseBands& bands) {
  int explained = 0;
  for (int i = 0; i < bands.count(); ++i) {
    double body = 0.0;
    for (const StrutBlock* block : blocks) body += block->bands[i].powers[StrutBlock::Band::kBody];
    if (power.row(i).sum() * bands.size(i) < kMajority * body) ++explained;
  }
  return explained > kMajority * bands.count();
}

}  // namespace

BlockEstimator::BlockEstimator(const BlockBand& band, const BlockColumns& columns)
    : equations_(band, columns),
      window_fit_(band, columns, kBlockWindows.back()),
      ring_(kBlockWindows.back(), equations_.makeBlock()),
      drive_(band, columns) {
  const int p = columns.numParameters();
  first_.mean.setZero(p);
  first_.stddev.setConstant(p, HUGE_VAL);
  first_.stddev[kBlockDelay] = delayStddev();
  first_.stddev[kBlockGain] = kBlockTuning.held;
  first_.mean[kBlockWheelShare] = kBlockTuning.share_mean;
  first_.stddev[kBlockWheelShare] = kBlockTuning.share_stddev;
  if (columns.neighbours > 0) {
    // Noise of all wheels is in e of every top, in proportions that change with frequency: no r is right, and what is
    // wrong by it counts where tracks are much alike. So instruments are those of the wheels as measured.
    first_.mean[kBlockWheelShare] = kBlockTuning.least_share;
    first_.stddev[kBlockWheelShare] = kBlockTuning.least_share / 2.0;
    first_.stddev[kBlockDelay] = kBlockTuning.held;
  }
  slow_ = scaled_ = first_;
  factor_.setOnes(p);
  factor_stddev_.setZero(p);
  theta_.setZero(p);
  shorter_.reserve(kBlockWindows.size());
  pointers_.reserve(kBlockWindows.back());
  sorted_.reserve(kBlockWindows.back());
}

StrutBlock& BlockEstimator::next() {
  if (count_ == kBlockWindows.back()) retire(block(kBlockWindows.back() - 1));
  ring_.rotate(ring_.begin() + 1);  // the oldest place is the newest now
  count_ = std::min(count_ + 1, kBlockWindows.back());
  block(0).at.setZero();
  return block(0);
}

void BlockEstimator::begin(const BlockVector& theta, const BlockPrior& slow) {
  theta_ = theta;
  slow_ = slow;
  first_.mean[kBlockGain] = slow.mean[kBlockGain];
  has_theta_ = true;
}

const std::vector<const StrutBlock*>& BlockEstimator::newest(int count, int from) {
  pointers_.clear();
  for (int age = from + count - 1; age >= from; --age) pointers_.push_back(&block(age));
  return pointers_;
}

bool BlockEstimator::fit(int window, const BlockPrior& prior, WindowEstimate& result, bool is_near, int from) {
  window_fit_.fit(newest(window, from), prior, theta_, weights_.median, scatter_, result, is_near);
  return result.isUsable();
}

std::optional<WindowEstimate> BlockEstimator::ofBlocks(int from, int count) {
  if (!has_theta_ || count < kBlockWindows.front() || from + count > count_) return std::nullopt;
  WindowEstimate result;
  if (!fit(count, first_, result, false, from)) return std::nullopt;
  return result;
}

const WindowEstimate* BlockEstimator::update() {
  if (!has_theta_ && waits_ > 0) {
    --waits_;
    return nullptr;
  }
  if (has_theta_) equations_.linearise(theta_, block(0));
  if (!hasBlocks() || !(has_theta_ || start())) {
    if (hasBlocks()) newest_worst_ = HUGE_VAL;
    return nullptr;
  }
  if (++updates_ % kBlockTuning.slow_every == 0 && count_ >= kBlockTuning.start_blocks) learnSlow();
  scaleSlow();
  const BlockPrior& prior = contradictsSlow() ? first_ : scaled_;
  int window = 0;
  shorter_.clear();
  for (const int m : kBlockWindows) {
    if (m > count_) break;
    const bool is_usable = fit(m, prior, trial_) && explainsSomething(trial_, equations_.band());
    if (m == kBlockWindows.front()) newest_worst_ = is_usable ? trial_.worst() : HUGE_VAL;
    if (!is_usable) continue;
    if (contradictsShorter(trial_)) break;  // what is older is of another strut
    if (window == 0 || trial_.worst() < best_.worst()) {
      std::swap(best_, trial_);
      window = m;
    }
    if (best_.worst() < kBlockTuning.enough) break;
  }
  if (window == 0) {
    has_theta_ = false;
    return nullptr;
  }
  refine(window, prior);
  has_theta_ = best_.isUsable() && best_.worst() < kBlockTuning.lost;
  if (!has_theta_) return nullptr;
  theta_ = best_.theta;
  // Blocks at rest can only make it worse: what is known is held.
  if (newestSayNothing() && (best_.explained < kMajority || best_.worst() >= reported_worst_)) return nullptr;
  reported_worst_ = best_.worst();
  return &best_;
}

bool BlockEstimator::start() {
  const bool is_alone = equations_.columns().neighbours == 0;
  scatter_ = 1.0;  // what was known is lost
  reported_worst_ = HUGE_VAL;
  // Where a strut was known and lost few blocks tell it from what went before, as from a burst of wrong readings.
  const bool was_known = is_alone && weights_.median.size() > 0;
  if (startBy(std::min(count_, kBlockTuning.start_blocks)) || (was_known && startBy(kBlockWindows.front()))) {
    for (int age = 0; age < count_; ++age) equations_.linearise(theta_, block(age));
    return true;
  }
  if (is_alone) return false;
  waits_ = kBlockTuning.slow_every - 1;
  double& stddev = first_.stddev[kBlockDelay];  // perhaps that is what was missing, or too much
  stddev = stddev == kBlockTuning.held ? delayStddev() : kBlockTuning.held;
  return false;
}

// Linear least squares, which noise of the regressors biases, then some steps from there; of a strut alone also with
// the gain open, as a sensor may read in another unit. Of motion at one frequency any gain explains all; so most of the
// bands have to tell. Where a strut was known the gain is, too: blocks of two loads would look like another one.
bool BlockEstimator::startBy(int window) {
  const bool is_found = startAt(equations_.start(newest(window)), window);
  if (equations_.columns().neighbours > 0 || weights_.median.size() > 0) return is_found;
  const BlockVector found = theta_, open = equations_.start(newest(window), true);
  const double mean = std::exchange(first_.mean[kBlockGain], open[kBlockGain]);
  const double stddev = std::exchange(first_.stddev[kBlockGain], HUGE_VAL);
  const bool has_other_gain = open[kBlockGain] > -1.0 && startAt(open, window) &&
                              trial_.explained > kBlockTuning.nearly_all &&
                              explainsMostBands(window_fit_.power(), pointers_, equations_.noiseBands());
  const bool differ = has_other_gain && window_fit_.gainsDiffer(trial_);
  if (!has_other_gain) theta_ = found;
  first_.mean[kBlockGain] = differ ? theta_[kBlockGain] : has_other_gain ? 0.0 : mean;
  first_.stddev[kBlockGain] = differ ? kBlockTuning.gain_stddev : stddev;
  slow_.mean[kBlockGain] = first_.mean[kBlockGain];
  slow_.stddev[kBlockGain] = first_.stddev[kBlockGain];
  return has_other_gain || is_found;
}

bool BlockEstimator::startAt(const BlockVector& linear, int window) {
  // A strut that bounces a quarter as fast as the lowest bin, damped by a tenth, is the softest that the blocks can
  // see.
  const double slowest = equations_.band().omega(BlockBand::kFirst) / 8.0;
  theta_ = first_.mean;
  theta_[kBlockDamping] = std::max(linear[kBlockDamping], 0.2 * slowest);
  theta_[kBlockStiffness] = std::max(linear[kBlockStiffness], slowest * slowest);
  const int neighbours = equations_.columns().neighbours;
  theta_.tail(neighbours) = linear.tail(neighbours);
  const int steps = neighbours > 0 ? kBlockTuning.vehicle_start_steps : kBlockTuning.start_steps;
  for (int i = 0; i < steps; ++i) {
    for (int age = 0; age < window; ++age) equations_.linearise(theta_, block(age));
    if (!fit(window, first_, trial_)) return false;
    theta_ = trial_.theta;
  }
  return trial_.worst() < kBlockTuning.lost && explainsSomething(trial_, equations_.band());
}

// A window ends where shorter ones say that the strut was another one, and the newest blocks leave more of it than
// the median block: at a stop an event that no strut explains, as the level of a tilted IMU, is all that they tell.
// Source: O. V. Lepskii, On a problem of adaptive estimation in Gaussian white noise (1991).
bool BlockEstimator::contradictsShorter(const WindowEstimate& estimate) {
  for (const Shorter& each : shorter_)
    if (((estimate.theta.head<2>() - each.theta).array().abs() > kProven * each.stddev.array()).any() &&
        leavesMoreThanMedian(each.blocks))
      return true;
  shorter_.push_back({estimate.blocks, estimate.theta.head<2>(), estimate.covariance.diagonal().head<2>().cwiseSqrt()});
  return false;
}

// @return true if the newest fit leaves more of the newest blocks than of the median one: of most of them, as an event
// is in one or two only.
bool BlockEstimator::leavesMoreThanMedian(int blocks) {
  if (weights_.median.size() == 0) return true;
  sorted_.clear();
  const auto newest = window_fit_.power().rightCols(blocks);
  for (int b = 0; b < blocks; ++b) sorted_.push_back(weights_.overMedian(newest.col(b)));
  return medianInPlace(sorted_) > kBlockTuning.excess;
}

bool BlockEstimator::isStale(const StrutBlock& block) const {
  const auto moved = [&](int i) { return std::abs(best_.theta[i] - block.at[i]); };
  const BlockBand& band = equations_.band();
  return moved(kBlockDamping) > kBlockTuning.stale * block.at[kBlockDamping] ||
         moved(kBlockStiffness) > kBlockTuning.stale * block.at[kBlockStiffness] ||
         moved(kBlockDelay) * band.omega(band.last) > kBlockTuning.stale_phase ||
         moved(kBlockWheelShare) > kBlockTuning.stale_share;
}

void BlockEstimator::refine(int window, const BlockPrior& prior) {
  int refined = 0;
  for (int age = 0; age < window && refined < kBlockTuning.start_blocks; ++age) {
    if (!isStale(block(age))) continue;
    equations_.linearise(best_.theta, block(age));
    ++refined;
  }
  if (refined == 0) return;
  trial_ = best_;
  window_fit_.fit(newest(window), prior, best_.theta, weights_.median, scatter_, trial_);
  if (trial_.isUsable()) std::swap(best_, trial_);
}

}  // namespace suspension_health_monitor
