#include "suspension_health_monitor/identification/excitation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suspension_health_monitor {
namespace {

constexpr double kLeastShare = 0.5;       // of psi^2
constexpr double kLeastExcitation = 4.5;  // of the noise's information
constexpr double kUsualShare = 0.1;       // of the usual information: no rest
constexpr double kByChance = 1e-8;        // that noise looks like a strut
constexpr double kMostGrowth = 4.0;       // of the usual in a block: an outlier does not become it
constexpr int kFewestRows = 64;           // of a block
constexpr double kUsualMemories = 10.0;
constexpr double kMostTimes = 2.0;      // the strut that is known
constexpr double kOffsetMemory = 0.98;  // forgetting factor of a look

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

Excitation::Excitation(int horizon_samples, double forgetting_factor, const RegressorNoise& noise)
    : looks_per_block_(std::max(horizon_samples, kFewestRows) / kJudgeEvery),
      most_blocks_(std::max(1.0, kUsualMemories / (looks_per_block_ * kJudgeEvery * (1.0 - forgetting_factor)))),
      kept_(1.0 - 1.0 / (most_blocks_ * looks_per_block_)),
      noise_(noise),
      offset_(kOffsetMemory) {
  // Of n outputs of white noise two regressors explain more than x with probability (1 - x)^((n - 2) / 2).
  for (int k = 0; k < kMostBlocks; ++k) {
    const double exponent = 2.0 / ((k + 1) * looks_per_block_ - 2);
    least_share_[static_cast<std::size_t>(k)] = std::max(kLeastShare, 1.0 - std::pow(kByChance, exponent));
  }
}

bool Excitation::judge(const RegressionRow& row, const Eigen::VectorXd& theta) {
  const double* const phi = row.regressor.data();
  double output = row.output;  // without what effects make of it
  for (Eigen::Index j = kNumStrutParameters; j < theta.size(); ++j) output -= phi[j] * theta[j];
  offset_.add(phi[kStiffnessToMass]);
  const double damping = phi[kDampingToMass], stiffness = phi[kStiffnessToMass] - offset_.mean();
  block_.add(damping, stiffness, output);
  if (++looks_ < looks_per_block_) return false;
  closeBlock();
  return true;
}

void Excitation::know(const Eigen::Vector2d& strut) { most_ = (kMostTimes * strut).cwiseMax(kept_ * most_); }

void Excitation::Part::learnUsual(double information, double most_blocks) {
  blocks = std::min(blocks + 1.0, most_blocks);
  const double most = blocks > 1.0 ? kMostGrowth * usual : information;
  usual += (std::min(information, most) - usual) / blocks;
}

void Excitation::closeBlock() {
  blocks_ = std::min(blocks_ + 1, 2);
  if (most_.all()) {
    if (is_held_) judgeHeld();  // first: what is released by older blocks is held again if the newest do not tell of it
    RowMoments recent = before_;
    recent += block_;
    judgeExcited(recent);
  }
  before_ = block_;
  block_ = RowMoments();
  looks_ = 0;
}

void Excitation::judgeExcited(const RowMoments& recent) {
  const StrutFit fit = recent.bestStrut(most_);
  const bool tells = fit.rest < (1.0 - kLeastShare) * recent.output;
  const auto excitation = excitationOf(recent, fit, noise_);
  const auto information = informationOf(recent), newest = informationOf(block_);
  bool is_new = false;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    if (!part.excited) continue;
    part.excitation = excitation[i];
    const double mean = information[i] / (blocks_ * looks_per_block_);
    if (tells && excitation[i] >= kLeastExcitation) {
      part.learnUsual(newest[i] / looks_per_block_, most_blocks_);
    } else if (blocks_ == 2 && mean < kUsualShare * part.usual) {
      part.excited = false;
      part.rough_blocks = 0;
      is_new = true;
    }
  }
  if (!is_new) return;
  is_held_ = true;
  window_ = RowMoments();
  window_blocks_ = 0;
}

void Excitation::judgeHeld() {
  window_ += block_;
  ++window_blocks_;
  const StrutFit fit = window_.bestStrut(most_);
  const bool tells = fit.rest < (1.0 - least_share_[static_cast<std::size_t>(window_blocks_ - 1)]) * window_.output;
  const auto excitation = excitationOf(window_, fit, noise_);
  const double least = kLeastExcitation * kMostBlocks / window_blocks_;
  const auto newest = informationOf(block_);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    if (part.excited) continue;
    part.excitation = excitation[i];
    const bool is_rough = newest[i] >= kUsualShare * part.usual * looks_per_block_;
    part.rough_blocks = is_rough ? part.rough_blocks + 1 : 0;
    part.excited = (tells && excitation[i] >= least) || part.rough_blocks >= kMostBlocks;
  }
  is_held_ = !(parts_[kDampingToMass].excited && parts_[kStiffnessToMass].excited);
  if (window_blocks_ < kMostBlocks && is_held_) return;
  window_ = RowMoments();
  window_blocks_ = 0;
}

void Excitation::restart() {
  reset();
  offset_ = RunningMean(kOffsetMemory);
  most_.setZero();
  parts_.fill(Part());
  is_held_ = false;
}

void Excitation::reset() {
  block_ = before_ = window_ = RowMoments();
  looks_ = blocks_ = window_blocks_ = 0;
  for (Part& part : parts_) part.rough_blocks = 0;
}

}  // namespace suspension_health_monitor
