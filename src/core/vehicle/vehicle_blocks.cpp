#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {
namespace {

const VehicleChannels& checked(const VehicleChannels& vehicle) {
  requireNumStruts(vehicle.struts.size());
  for (const VehicleChannels::Strut& strut : vehicle.struts)
    if (!strut.sprung && !strut.position) throw std::invalid_argument("a strut without a sprung IMU needs a position");
  return vehicle;
}

}  // namespace

VehicleBlocks::VehicleBlocks(const VehicleChannels& vehicle, double period, double length, std::size_t effects)
    : vehicle_(checked(vehicle)),
      effects_(effects),
      period_(period),
      length_(length),
      columns_{static_cast<int>(vehicle.known_forces.size() + std::max<std::size_t>(effects, 1)),
               2 * (static_cast<int>(size()) - 1), effects == 0},
      estimates_(size()),
      has_(size(), false),
      last_(2 * size() + vehicle.known_forces.size() + 2),
      modulation_(BlockBand(length_, period)) {
  for (std::size_t i = 0; i < size(); ++i) estimates_[i].strut = i;
  while (period_ >= kBlockTuning.longest_spacing * length_) length_ *= 2.0;
  begin(length_);
}

void VehicleBlocks::begin(double length) {
  const BlockBand band(length, period_);
  std::vector<BlockEstimator> before = std::exchange(estimators_, {});
  length_ = length;
  modulation_ = Modulation(band);
  spectra_.emplace(band, vehicle_, effects_);
  friction_.assign(size(), SlidingFriction::ofBlocks(length));
  // Until there is an estimate: a strut with a damping ratio of 0.3, in the middle of the bounces of this length.
  const double bounce =
      2.0 * M_PI *
      std::sqrt(kVehicleTuning.least_upper_edge / (1.0 + kVehicleTuning.start_damping) * kVehicleTuning.most_periods) /
      length;
  for (SlidingFriction& each : friction_) each.setStrut(kVehicleTuning.start_damping * bounce, bounce * bounce, 0.0);
  for (std::size_t i = 0; i < size(); ++i) {
    estimators_.emplace_back(band, columns_);
    if (!before.empty() && before[i].hasTheta()) estimators_[i].begin(before[i].theta(), before[i].slowPrior());
  }
  if (coveredBy(before) > coveredBy(longest_)) longest_ = std::move(before);
  has_model_ = isAlone();
  if (!isAlone()) rows_ = model_.emplace(band, size(), vehicle_.known_forces.size()).rows();
  motions_.setZero(band.size(), 2 * size());
  origin_.reset();
  to_update_ = size();
  to_predict_ = 0;
  next_half_ = 1;
}

void VehicleBlocks::restart() {
  for (BlockEstimator& each : estimators_) each.restart();
  for (SlidingFriction& each : friction_) each.restart();
  spectra_->restart();
  has_.assign(has_.size(), false);
  last_.assign(last_.size(), std::nullopt);
  origin_.reset();
  to_update_ = size();
  to_predict_ = 0;
  next_half_ = 1;
}

// A clock that went back, or a stamp that was far ahead: what follows has nothing to do with what was before.
std::optional<double> VehicleBlocks::timeOf(std::size_t stream, Stamp stamp) {
  if (last_[stream] && stamp <= *last_[stream]) restart();
  last_[stream] = stamp;
  if (!origin_) origin_ = stamp;
  const double time = toSeconds(stamp - *origin_);
  if (time < 0.0) return std::nullopt;  // another stream began later
  return time;
}

const TopEstimate* VehicleBlocks::push(const VehicleReading& reading) {
  const std::size_t place = reading.place, first[] = {0, size(), 2 * size(), 2 * size() + 1};
  const auto time = timeOf(first[static_cast<std::size_t>(reading.sensor)] + place, reading.stamp);
  if (!time) return nullptr;
  double direction = 0.0;
  if (reading.sensor == VehicleReading::Sensor::kUnsprung && looksForFriction()) {
    const BlockVector& theta = estimators_[place].theta();
    if (estimators_[place].hasTheta())
      friction_[place].setStrut(theta[kBlockDamping], theta[kBlockStiffness], theta[columns_.firstForce()]);
    direction = friction_[place].push(*time, reading.values[0]);
  }
  spectra_->push(reading, *time, direction);
  return work();
}

const TopEstimate* VehicleBlocks::pushEffects(Stamp stamp, const double* forces) {
  const auto time = timeOf(last_.size() - 1, stamp);
  if (!time) return nullptr;
  spectra_->pushEffects(*time, forces);
  return work();
}

const TopEstimate* VehicleBlocks::push(const CornerSample& sample, Stamp lag) {
  if (!isUsable(sample.sprung_acceleration) || !isUsable(sample.unsprung_acceleration)) return nullptr;
  const TopEstimate* of_body = push(readingOf(Side::kSprung, sample.stamp - lag, sample.sprung_acceleration));
  const TopEstimate* of_wheel = push(readingOf(Side::kUnsprung, sample.stamp, sample.unsprung_acceleration));
  return of_wheel != nullptr ? of_wheel : of_body;
}

// One portion per reading; a strut alone takes no longer than a portion.
const TopEstimate* VehicleBlocks::work() {
  if (to_update_ < size()) {
    const TopEstimate* found = update(to_update_++);
    if (to_update_ < size()) return found;
    if (!isAlone()) updateModel();
    if (found != nullptr || !isAlone()) follow();
    return found;
  }
  if (to_predict_ > 0) {
    predict(--to_predict_);
    for (BlockEstimator& each : estimators_) each.linearise(each.block(to_predict_));
    return nullptr;
  }
  // A stream that is silent holds the others up only as long as their half blocks are kept.
  next_half_ = std::max(next_half_, spectra_->newestOpen() - FourierIntegrals::kHalves + 2);
  const TopEstimate* found = nullptr;
  while (spectra_->isPassed(next_half_)) {
    takeBlock();
    if (!isAlone()) break;
    if (to_update_ == 0)
      if (const TopEstimate* newest = work()) found = newest;
  }
  return found;
}

void VehicleBlocks::takeBlock() {
  const long half = next_half_++;
  if (!spectra_->isWhole(half)) return;
  if (spectra_->checkGyro(half)) return;
  for (std::size_t i = 0; i < size(); ++i) spectra_->fill(i, half, estimators_[i].next());
  if (!isAlone()) {
    fillNeighbours();
    predict(0);
  }
  newest_half_ = half;
  to_update_ = 0;
}

void VehicleBlocks::fillNeighbours() {
  for (std::size_t j = 0; j < size(); ++j) {
    const StrutBlock& block = estimators_[j].block(0);
    modulation_.setDelay(estimators_[j].hasTheta() ? estimators_[j].slowPrior().mean[kBlockDelay] : 0.0);
    for (const std::size_t p : {1, 0}) {
      auto motion = motions_.col(2 * j + 1 - p);
      modulation_.apply(p, block.wheel, motion);
      if (estimators_[j].hasTheta()) motion *= 1.0 + estimators_[j].slowPrior().mean[kBlockGain];
      motion -= block.body.col(p);
    }
  }
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t j = 0; j < size(); ++j)
      if (j != i)
        estimators_[i].block(0).neighbours.middleCols(neighbourColumn(i, j), 2) = motions_.middleCols(2 * j, 2);
}

// Without a model what was measured is all there is.
void VehicleBlocks::predict(int age) {
  if (has_model_) model_->predict(estimators_, age, firstKnownForce());
  for (std::size_t i = 0; i < size(); ++i) {
    StrutBlock& block = estimators_[i].block(age);
    if (!has_model_) {
      block.predicted_neighbours = block.neighbours;
      block.predicted_travel = motions_.col(2 * i + 1);
      continue;
    }
    block.predicted_travel = model_->travel().col(i);
    for (std::size_t j = 0; j < size(); ++j) {
      if (j == i) continue;
      const int at = neighbourColumn(i, j);
      block.predicted_neighbours.col(at + 1) = model_->travel().col(j);
      block.predicted_neighbours.col(at) = modulation_.s() * block.predicted_neighbours.col(at + 1);
    }
  }
}

const TopEstimate* VehicleBlocks::update(std::size_t strut) {
  BlockEstimator& estimator = estimators_[strut];
  scaleNeighbours(strut);
  const WindowEstimate* found = estimator.update();
  if (found == nullptr || !has_model_) return nullptr;
  TopEstimate& estimate = estimates_[strut];
  static_cast<WindowEstimate&>(estimate) = *found;
  estimate.length = length_;
  if (looksForFriction()) estimate.friction = found->theta[columns_.firstForce()];
  estimate.stamp = *origin_ + fromSeconds(static_cast<double>(newest_half_ + 1) * length_ / 2.0);
  has_[strut] = true;
  return &estimate;
}

// b_ij / b_jj belongs to the body: where strut j differs now from what all blocks say of it, so do its columns here.
void VehicleBlocks::scaleNeighbours(std::size_t strut) {
  for (std::size_t j = 0; j < size(); ++j) {
    const auto& all = estimators_[j].ofAllBlocks();
    if (j == strut || !all || !has_[j]) continue;
    const TopEstimate& now = estimates_[j];
    for (const int i : {kBlockDamping, kBlockStiffness}) {
      const double factor = now.theta[i] / all->theta[i], stddev = std::sqrt(now.covariance(i, i)) / all->theta[i];
      const bool has_changed = std::abs(factor - 1.0) > kLikely * stddev;
      const int column = rateColumn(columns_, strut, j) + i;
      estimators_[strut].scaleSlow(column, has_changed ? factor : 1.0, has_changed ? stddev : 0.0);
    }
  }
}

// All tops are up to date: so may be the model of them all.
void VehicleBlocks::updateModel() {
  for (const BlockEstimator& each : estimators_)
    if (!each.hasTheta()) return;
  const std::size_t n = size();
  bool is_stale = !has_model_;
  const int known = columns_.firstForce() + firstKnownForce();
  for (std::size_t i = 0; i < n; ++i) {
    const BlockVector& theta = estimators_[i].theta();
    for (std::size_t j = 0; j < n; ++j) {
      const int at = rateColumn(columns_, i, j);
      rows_.rate(i, j) = theta[at];
      rows_.travel(i, j) = theta[at + 1];
    }
    rows_.force.row(i) = theta.segment(known, rows_.force.cols()).transpose();
    const BodyRows& before = model_->rows();
    const auto moved = [&](const Eigen::MatrixXd& now, const Eigen::MatrixXd& then) {
      // Instruments need not be exact: an error of a tenth costs a hundredth of the information.
      return (now.row(i) - then.row(i)).cwiseAbs().maxCoeff() > kSmall * now.row(i).cwiseAbs().maxCoeff();
    };
    is_stale = is_stale || moved(rows_.rate, before.rate) || moved(rows_.travel, before.travel);
  }
  if (!is_stale) return;
  model_->setRows(rows_);
  if (!has_model_)
    for (BlockEstimator& each : estimators_) each.forgetSlow();
  has_model_ = true;
  for (std::size_t i = 0; i < n; ++i) estimators_[i].setWheelNoise(model_->wheelNoise(i, estimators_[i].equations()));
  to_predict_ = estimators_.front().count();
}

// Blocks that are too short lose the bounce below their lowest bin, of two periods in a block, the more of it the
// sharper its resonance is; in blocks of more than kVehicleTuning.most_periods it is in few bins of many, and they are
// slower than they need to be. The strut that bounces slowest decides.
void VehicleBlocks::follow() {
  double periods = std::numeric_limits<double>::infinity(), upper_edge = periods;
  for (const BlockEstimator& each : estimators_) {
    if (!each.hasTheta()) return;
    const double bounce = std::sqrt(each.theta()[kBlockStiffness]), own = length_ * bounce / (2.0 * M_PI);
    periods = std::min(periods, own);
    // of the resonance, its width above its peak
    upper_edge = std::min(upper_edge, own * (1.0 + each.theta()[kBlockDamping] / bounce));
  }
  if (upper_edge < kVehicleTuning.least_upper_edge)
    begin(2.0 * length_);
  else if (periods > kVehicleTuning.most_periods && period_ < kBlockTuning.longest_spacing * length_ / 2.0)
    begin(0.5 * length_);
}

}  // namespace suspension_health_monitor
