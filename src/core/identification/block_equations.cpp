#include "suspension_health_monitor/internal/identification/block_equations.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kMostBlocks = 512;
constexpr std::size_t kRuns = 32;    // that do not overlap: so well is the scatter of the blocks known
constexpr double kStandsOut = 10.0;  // times the median; of normal scores one block in a thousand does
constexpr int kIterations = 30;

/// Sum over blocks, each with its weight.
EquationBlock weightedSum(const std::vector<EquationBlock>& blocks, const std::vector<double>& weights) {
  EquationBlock sum;
  for (std::size_t b = 0; b < blocks.size(); ++b) sum += blocks[b].scaled(weights[b]);
  return sum;
}

Eigen::Vector3d score(const EquationBlock& block, const Eigen::Vector3d& theta) {
  return block.outputs - block.information * theta;
}

/// Size of a block's scores against what they would be of residuals of 1: squared, in the unit of psi squared.
double size(const EquationBlock& block, const Eigen::Vector3d& theta) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    if (block.squares[i] > 0.0) sum += std::pow(score(block, theta)[i], 2) / block.squares[i];
  return sum;
}

}  // namespace

void EquationBlock::add(const Eigen::Vector2d& instrument, const Eigen::Vector2d& regressor, double output,
                        const Eigen::Vector2d& rate) {
  const Eigen::Vector3d z(instrument[0], instrument[1], 1.0);
  information += z * Eigen::Vector3d(regressor[0], regressor[1], 1.0).transpose();
  outputs += z * output;
  rates += z * rate.transpose();
  squares += z.cwiseAbs2();
}

std::optional<Eigen::Vector3d> EquationBlock::solution() const {
  const Eigen::FullPivLU<Eigen::Matrix3d> factors(information);
  if (!factors.isInvertible()) return std::nullopt;
  return factors.solve(outputs);
}

EquationBlock& EquationBlock::operator+=(const EquationBlock& other) {
  information += other.information;
  outputs += other.outputs;
  rates += other.rates;
  squares += other.squares;
  return *this;
}

void BlockEquations::add(const Eigen::Vector2d& instrument, const Eigen::Vector2d& regressor, double output,
                         const Eigen::Vector2d& rate) {
  open_.add(instrument, regressor, output, rate);
  if (open_.rows() < rows_per_block_) return;
  blocks_.push_back(open_);
  open_ = {};
  if (blocks_.size() == kMostBlocks) halve();
}

void BlockEquations::halve() {
  for (std::size_t b = 0; b < kMostBlocks / 2; ++b) {
    blocks_[b] = blocks_[2 * b];
    blocks_[b] += blocks_[2 * b + 1];
  }
  blocks_.resize(kMostBlocks / 2);
  rows_per_block_ *= 2;
}

std::optional<BlockSolution> BlockEquations::solution(const EquationBlock& noise) const {
  if (blocks_.size() < kFewestBlocks) return std::nullopt;
  std::vector<EquationBlock> blocks = blocks_;
  for (EquationBlock& block : blocks) {
    block.information -= block.rows() * noise.information;
    block.outputs -= block.rows() * noise.outputs;
  }
  std::vector<double> weights(blocks.size(), 1.0), sizes(blocks.size());
  Eigen::Vector3d theta;
  Eigen::FullPivLU<Eigen::Matrix3d> factors;
  for (int i = 0; i < kIterations; ++i) {
    const EquationBlock sum = weightedSum(blocks, weights);
    factors.compute(sum.information);
    if (!factors.isInvertible()) return std::nullopt;
    theta = factors.solve(sum.outputs);
    for (std::size_t b = 0; b < blocks.size(); ++b) sizes[b] = size(blocks[b], theta);
    const double limit = kStandsOut * median(sizes);
    // The first half of the way the criterion is convex, so that it ends at one place wherever it begins.
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const double excess = sizes[b] > limit ? limit / sizes[b] : 1.0;
      weights[b] = 2 * i < kIterations ? std::sqrt(excess) : excess;
    }
  }
  const std::size_t run = std::max<std::size_t>(2, blocks.size() / kRuns);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  // Overlapping runs, with ends that stand half outside, so that every block is in as many.
  Eigen::Vector3d in_run = Eigen::Vector3d::Zero();
  for (std::size_t b = 0; b < blocks.size() + run - 1; ++b) {
    if (b < blocks.size()) in_run += weights[b] * score(blocks[b], theta);
    if (b >= run) in_run -= weights[b - run] * score(blocks[b - run], theta);
    scatter += in_run * in_run.transpose() / static_cast<double>(run);
  }
  const auto n = static_cast<double>(blocks.size()) / static_cast<double>(run);
  const Eigen::Matrix3d inverse = factors.inverse();
  const Eigen::Matrix3d variance = n / (n - 1.0) * inverse * scatter * inverse.transpose();
  const EquationBlock sum = weightedSum(blocks, weights);
  return BlockSolution{theta.head<2>(), variance.diagonal().head<2>().cwiseSqrt(), sum.rows(),
                       (inverse * sum.rates * theta.head<2>()).head<2>()};
}

}  // namespace suspension_health_monitor
