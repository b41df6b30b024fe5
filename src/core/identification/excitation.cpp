#include "suspension_health_monitor/internal/identification/excitation.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

// Of n rows of white noise two regressors explain more than a share x of psi^2 with probability (1 - x)^((n - 2) / 2):
// a half of one block's once in 2e9.
constexpr double kLeastShare = 0.5;
constexpr int kFewestBlockRows = 64;               // of a block
constexpr int kMostJudgedBlocks = 8;               // that are judged together before a parameter is released
constexpr double kUsualShare = 0.1;                // of the usual information: no rest
constexpr double kWheelStands = 0.01;              // of the wheel's usual part
constexpr double kMostGrowth = 4.0;                // of the usual in a block: an outlier does not become it
constexpr double kUsualMemories = 10.0;            // of the estimator, that the usual lasts
constexpr double kMostTimes = 2.0;                 // the known strut
constexpr double kLarger = 2.0, kFarLarger = 9.0;  // the body's part over the wheel's
constexpr double kOffsetMemory = 0.9975;           // forgetting factor of a row

std::array<double, kNumStrutParameters> informationOf(const RowMoments& rows) {
  return {rows.damping_information, rows.stiffness_information};
}

}  // namespace

std::array<double, kNumStrutParameters> excitationOf(const RowMoments& rows, const StrutFit& fit,
                                                     const RegressorNoise& noise) {
  const double sensor = fit.rest / noise.residualGain(fit.theta);
  return {rows.damping_information / (sensor * noise.regressorGain(kDampingToMass)),
          rows.stiffness_information / (sensor * noise.regressorGain(kStiffnessToMass))};
}

Excitation::Block& Excitation::Block::operator+=(const Block& other) {
  moments += other.moments;
  body += other.body;
  wheel += other.wheel;
  rows += other.rows;
  blocks += other.blocks;
  return *this;
}

void Excitation::Usual::learn(double information, double most_blocks) {
  blocks = std::min(blocks + 1.0, most_blocks);
  const double most = blocks > 1.0 ? kMostGrowth * mean : information;
  mean += (std::min(information, most) - mean) / blocks;
}

Excitation::Excitation(int horizon_samples, double forgetting_factor, const RegressorNoise& noise)
    : block_rows_(std::max(horizon_samples, kFewestBlockRows)),
      most_blocks_(std::max(1.0, kUsualMemories / (block_rows_ * (1.0 - forgetting_factor)))),
      noise_(noise),
      offset_(kOffsetMemory) {}

bool Excitation::add(const RegressionRow& row, double output, double wheel_output) {
  offset_.add(row.regressor[kStiffnessToMass]);
  block_.moments.add(row.regressor[kDampingToMass], row.regressor[kStiffnessToMass] - offset_.mean(), output);
  block_.body += row.output * row.output;
  block_.wheel += wheel_output * wheel_output;
  if (++block_.rows < block_rows_) return false;
  closeBlock();
  return true;
}

void Excitation::know(const Eigen::Vector2d& strut) {
  most_ = (kMostTimes * strut).cwiseMax((1.0 - 1.0 / (most_blocks_ * block_rows_)) * most_);
  is_known_ = true;
}

void Excitation::closeBlock() {
  block_.blocks = 1;
  judgeWheel();
  if (knowsStrut()) {
    if (isHeld()) judgeHeld();  // first: what is released by older blocks is held again if the newest do not tell of it
    Block recent = before_;
    recent += block_;
    judgeExcited(recent);
  }
  before_ = block_;
  block_ = Block();
  is_known_ = false;
}

void Excitation::judgeWheel() {
  Usual& usual = usual_[kWheel];
  const double wheel = block_.wheel / block_.rows, body = block_.body / block_.rows;
  const bool is_much_larger = body > kFarLarger * wheel;
  outside_force_ = usual.blocks > 0.0 ? wheel < kWheelStands * usual.mean && body > kLarger * wheel : is_much_larger;
  if (is_known_ && !outside_force_ && !is_much_larger) usual.learn(wheel, most_blocks_);
}

void Excitation::judgeExcited(const Block& recent) {
  const Told told = toldBy(recent);
  const auto information = informationOf(recent.moments), newest = informationOf(block_.moments);
  bool is_new = false;
  const auto hold = [&](Part& part) {
    part.excited = false;
    part.rough_blocks = 0;
    is_new = true;
  };
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    if (!part.excited) continue;
    part.excitation = told.excitation[i];
    if (told.of_strut && told.excitation[i] >= kLeastExcitation) {
      usual_[i].learn(newest[i] / block_.rows, most_blocks_);
    } else if (recent.blocks == 2 && information[i] / recent.rows < kUsualShare * usual_[i].mean) {
      hold(part);
    }
  }
  // On the way to a stop one goes before the other: beside one that is held the other one stays if it tells as much as
  // one that is held needs to be released.
  if (isHeld() && recent.blocks == 2)
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (parts_[i].excited && !told.releases(i)) hold(parts_[i]);
  if (is_new) since_held_ = Block();
}

Excitation::Told Excitation::toldBy(const Block& rows) const {
  const StrutFit fit = rows.moments.bestStrut(most_);
  return {fit.rest < (1.0 - kLeastShare) * rows.moments.output, excitationOf(rows.moments, fit, noise_),
          kLeastExcitation * kMostJudgedBlocks / rows.blocks};
}

void Excitation::judgeHeld() {
  since_held_ += block_;
  const Told told = toldBy(since_held_);
  const auto newest = informationOf(block_.moments);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    if (part.excited) continue;
    part.excitation = told.excitation[i];
    const bool is_rough = newest[i] >= kUsualShare * usual_[i].mean * block_.rows;
    part.rough_blocks = is_rough ? part.rough_blocks + 1 : 0;
    part.excited = told.releases(i) || part.rough_blocks >= kMostJudgedBlocks;
  }
  if (since_held_.blocks == kMostJudgedBlocks || !isHeld()) since_held_ = Block();
}

void Excitation::restart() {
  reset();
  offset_ = LimitedMean(kOffsetMemory);
  most_.setZero();
  parts_.fill(Part());
  usual_.fill(Usual());
  outside_force_ = false;
}

void Excitation::reset() {
  block_ = before_ = since_held_ = Block();
  is_known_ = false;
  for (Part& part : parts_) part.rough_blocks = 0;
}

}  // namespace suspension_health_monitor
