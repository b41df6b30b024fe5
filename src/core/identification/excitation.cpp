#include "suspension_health_monitor/identification/excitation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suspension_health_monitor {
namespace {

constexpr double kLeastInformation = 0.03;  // of the usual
constexpr double kLeastPart = 1.5;          // of theta_i phi_i to the residual
constexpr double kMostGrowth = 4.0;         // of the usual in a block: an outlier does not become it
constexpr int kFewestRows = 64;             // of a block
constexpr double kUsualMemories = 10.0;
constexpr double kOffsetMemory = 0.98;      // forgetting factor of a look

double square(double x) { return x * x; }

}  // namespace

Excitation::Excitation(int horizon_samples, double forgetting_factor)
    : looks_per_block_(std::max(horizon_samples, kFewestRows) / kJudgeEvery),
      most_blocks_(std::max(1.0, kUsualMemories / (looks_per_block_ * kJudgeEvery * (1.0 - forgetting_factor)))),
      offset_(kOffsetMemory) {
  for (Part& part : parts_) part.ratio = std::numeric_limits<double>::quiet_NaN();
}

bool Excitation::judge(const RegressionRow& row, const Eigen::VectorXd& theta) {
  offset_.add(row.regressor[kStiffnessToMass]);
  const std::array<double, kNumStrutParameters> deviations{row.regressor[kDampingToMass],
                                                           row.regressor[kStiffnessToMass] - offset_.mean()};
  bool changed = false;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double information = square(deviations[i]);
    parts_[i].information += information;
    parts_[i].size += std::abs(deviations[i] * theta[column]);
    // At once when it drives off.
    if (!parts_[i].excited && information > parts_[i].usual) changed = parts_[i].excited = true;
  }
  residual_ += std::abs(row.output - row.regressor.dot(theta));
  if (++looks_ < looks_per_block_) return changed;
  closeBlock();
  return true;
}

void Excitation::closeBlock() {
  for (Part& part : parts_) {
    const double information = part.information / looks_;
    part.ratio = residual_ > 0.0 ? part.size / residual_ : std::numeric_limits<double>::infinity();
    part.excited = !armed_ || information >= kLeastInformation * part.usual || part.ratio >= kLeastPart;
    if (part.excited) {
      part.blocks = std::min(part.blocks + 1.0, most_blocks_);
      const double most = part.blocks > 1.0 ? kMostGrowth * part.usual : information;
      part.usual += (std::min(information, most) - part.usual) / part.blocks;
    }
  }
  reset();
}

void Excitation::reset() {
  looks_ = 0;
  residual_ = 0.0;
  for (Part& part : parts_) part.information = part.size = 0.0;
}

}  // namespace suspension_health_monitor
