#include "suspension_health_monitor/internal/blocks/strut_blocks.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {
namespace {

constexpr double kFewestReadings = 33.0;  // of a block: fewer are a gap each, see FourierIntegrals
constexpr double kUsualDamping = 0.6;     // b1 over the bounce: a damping ratio of 0.3

}  // namespace

StrutBlocks::StrutBlocks(const BlockOptions& options, double period, std::size_t effects)
    : options_(options), period_(period), effects_(effects) {
  double length = options.length;
  while (length < kFewestReadings * period) length *= 2.0;
  begin(length);
}

void StrutBlocks::begin(double length) {
  const BlockBand band(length, period_);
  const BlockColumns columns{effects_ > 0 ? static_cast<int>(effects_) : 1, 0};
  std::optional<BlockEstimator> before;
  before.swap(estimator_);
  estimator_.emplace(band, columns, options_);
  if (before && before->hasTheta()) estimator_->begin(before->theta(), before->slowPrior());
  body_.resize(band.spectrumSize());
  streams_.clear();
  streams_.emplace_back(band, 1);
  streams_.emplace_back(band, effects_ > 0 ? 1 : 2);
  if (effects_ > 0) streams_.emplace_back(band, effects_);
  friction_.reset();
  if (effects_ == 0) {
    friction_ = SlidingFriction::ofBlocks(length);
    // Until there is an estimate: a usual strut in the middle of the bounces that this length is for.
    const double bounce = 2.0 * M_PI * std::sqrt(kLeastUpperEdge / (1.0 + kUsualDamping) * kMostPeriods) / length;
    friction_->setStrut(kUsualDamping * bounce, bounce * bounce, 0.0);
  }
  origin_.reset();
  next_half_ = 1;
  estimate_.length = length;
}

void StrutBlocks::restart() {
  estimator_->restart();
  for (FourierIntegrals& stream : streams_) stream.restart();
  if (friction_) friction_->restart();
  last_ = {};
  origin_.reset();
  next_half_ = 1;
  has_estimate_ = false;
}

std::optional<BlockEstimate> StrutBlocks::overTheDrive() {
  const std::optional<WindowEstimate> found = estimator_->overTheDrive();
  if (!found) return std::nullopt;
  BlockEstimate result = estimate_;
  static_cast<WindowEstimate&>(result) = *found;
  return result;
}

const BlockEstimate* StrutBlocks::push(Side side, Stamp stamp, double acceleration) {
  // A clock that went back, or a stamp that was far ahead: what follows has nothing to do with what was before.
  std::optional<Stamp>& last = last_[static_cast<std::size_t>(side)];
  if (last && stamp <= *last) restart();
  last = stamp;
  if (!origin_) origin_ = stamp;
  const double time = toSeconds(stamp - *origin_);
  if (time < 0.0) return nullptr;  // the other stream began later
  if (side == Side::kSprung) {
    streams_[0].push(time, &acceleration);
  } else if (friction_) {
    const BlockVector& theta = estimator_->theta();
    if (estimator_->hasTheta())
      friction_->setStrut(theta[kBlockDamping], theta[kBlockStiffness], theta[kNumBlockParameters]);
    const double values[] = {acceleration, friction_->push(time, acceleration)};
    streams_[1].push(time, values);
  } else {
    streams_[1].push(time, &acceleration);
  }
  return takeBlocks();
}

const BlockEstimate* StrutBlocks::push(const CornerSample& sample, Stamp lag) {
  if (!isUsable(sample.sprung_acceleration) || !isUsable(sample.unsprung_acceleration)) return nullptr;
  const BlockEstimate* of_body = push(Side::kSprung, sample.stamp - lag, sample.sprung_acceleration);
  const BlockEstimate* of_wheel = push(Side::kUnsprung, sample.stamp, sample.unsprung_acceleration);
  return of_wheel != nullptr ? of_wheel : of_body;
}

const BlockEstimate* StrutBlocks::pushForces(Stamp stamp, const double* forces) {
  if (!origin_) origin_ = stamp;
  const double time = toSeconds(stamp - *origin_);
  if (time < 0.0) return nullptr;
  streams_[2].push(time, forces);
  return takeBlocks();
}

bool StrutBlocks::isPassed(long half) const {
  return std::all_of(streams_.begin(), streams_.end(), [&](const auto& stream) { return stream.openHalf() > half; });
}

const BlockEstimate* StrutBlocks::takeBlocks() {
  // A stream that is silent holds the others up only as long as their half blocks are kept.
  long newest = 0;
  for (const FourierIntegrals& stream : streams_) newest = std::max(newest, stream.openHalf());
  next_half_ = std::max(next_half_, newest - FourierIntegrals::kHalves + 2);
  const BlockEstimate* found = nullptr;
  while (isPassed(next_half_)) {
    const bool is_whole = std::all_of(streams_.begin(), streams_.end(), [&](const auto& stream) {
      return stream.half(next_half_ - 1) != nullptr && stream.half(next_half_) != nullptr;
    });
    const long half = next_half_++;
    if (!is_whole) continue;
    fill(half, estimator_->next());
    const WindowEstimate* estimate = estimator_->update();
    if (estimate == nullptr) continue;
    static_cast<WindowEstimate&>(estimate_) = *estimate;
    const double length = estimate_.length;
    estimate_.stamp = *origin_ + fromSeconds(static_cast<double>(half + 1) * length / 2.0);
    has_estimate_ = true;
    found = &estimate_;
    follow(estimate->theta[kBlockDamping], estimate->theta[kBlockStiffness]);
    if (estimate_.length != length) break;
  }
  return found;
}

void StrutBlocks::fill(long half, StrutBlock& block) {
  const BlockBand& band = estimator_->equations().band();
  const auto whole = [&](std::size_t stream, Eigen::Index channel, auto&& result) {
    streams_[stream].sumHalves(half, channel, result);
  };
  block.end = static_cast<double>(half + 1) * band.length / 2.0;
  whole(1, 0, block.wheel);
  for (Eigen::Index m = 0; m < block.forces.cols(); ++m)
    effects_ > 0 ? whole(2, m, block.forces.col(m)) : whole(1, 1, block.forces.col(m));
  whole(0, 0, body_);
  for (std::size_t p = 0; p < 3; ++p)
    estimator_->equations().undelayed().apply(p, body_, block.body.col(static_cast<Eigen::Index>(p)));
}

// Blocks that are too short lose the bounce below their lowest bin, of two periods in a block, the more of it the
// sharper its resonance is; in blocks of more than kMostPeriods it is in few bins of many, and they are slower than
// they need to be.
void StrutBlocks::follow(double damping, double stiffness) {
  const double bounce = std::sqrt(stiffness), periods = estimate_.length * bounce / (2.0 * M_PI);
  const double upper_edge = periods * (1.0 + damping / bounce);  // of the resonance, its width above its peak
  if (upper_edge < kLeastUpperEdge)
    begin(2.0 * estimate_.length);
  else if (periods > kMostPeriods && estimate_.length >= 2.0 * kFewestReadings * period_)
    begin(0.5 * estimate_.length);
}

}  // namespace suspension_health_monitor
