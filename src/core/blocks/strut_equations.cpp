#include "suspension_health_monitor/internal/blocks/strut_equations.h"

#include <Eigen/LU>
#include <limits>

namespace suspension_health_monitor {
namespace {

// Complex columns as real ones of twice the length: their products are sums of Re(a* b).
Eigen::Map<const Eigen::MatrixXd> asReal(const Eigen::MatrixXcd& columns) {
  return {reinterpret_cast<const double*>(columns.data()), 2 * columns.rows(), columns.cols()};
}

}  // namespace

StrutBlock::Band::Band(Eigen::Index p)
    : information(p, p), instruments(p, p), score(p), share(p), moments(p + 1, p + 1) {
  setZero();
}

void StrutBlock::Band::setZero() {
  information.setZero();
  instruments.setZero();
  score.setZero();
  share.setZero();
  moments.setZero();
  powers.setZero();
}

void StrutBlock::Band::add(double weight, const Band& other) {
  information += weight * other.information;
  instruments += weight * other.instruments;
  score += weight * other.score;
  share += weight * other.share;
  moments += weight * other.moments;
  powers += weight * other.powers;
}

StrutEquations::StrutEquations(const BlockBand& band, const BlockColumns& columns)
    : band_(band), noise_bands_(band), columns_(columns), undelayed_(band), delayed_(band), s_(undelayed_.s()) {
  for (Eigen::ArrayXcd* each : {&a_, &g_, &gain_, &wheel_, &e_over_g_}) each->resize(s_.size());
  x_.resize(s_.size(), 3);
  rho_.resize(s_.size());
  rho_slope_.resize(s_.size());
  instruments_.resize(s_.size(), columns.numParameters());
  regressors_.resize(s_.size(), columns.numParameters() + 1);
}

StrutBlock StrutEquations::makeBlock() const {
  StrutBlock block;
  block.wheel.setZero(band_.spectrumSize());
  block.forces.setZero(band_.spectrumSize(), columns_.forces);
  block.body.setZero(s_.size(), 3);
  block.neighbours.setZero(s_.size(), columns_.neighbours);
  block.predicted_neighbours = block.neighbours;
  if (columns_.neighbours > 0) block.predicted_travel.setZero(s_.size());
  block.at.setZero(columns_.numParameters());
  block.bands.assign(noise_bands_.count(), StrutBlock::Band(columns_.numParameters()));
  return block;
}

void StrutEquations::linearise(const BlockVector& theta, StrutBlock& block) {
  const double b1 = theta[kBlockDamping], b0 = theta[kBlockStiffness], r = theta[kBlockWheelShare];
  const Eigen::Index p = columns_.numParameters();
  delayed_.setDelay(theta[kBlockDelay]);
  for (int i = 0; i < 3; ++i) delayed_.apply(i, block.wheel, x_.col(i));
  const double own_gain = 1.0 + theta[kBlockGain];
  x_ *= own_gain;
  const auto x0 = x_.col(0), x1 = x_.col(1), x2 = x_.col(2);
  const auto y0 = block.body.col(0), y1 = block.body.col(1), y2 = block.body.col(2);
  g_ = b1 * s_ + b0;
  a_ = s_ * s_ + g_;
  gain_ = g_ / a_;

  auto residual = regressors_.col(p).array();
  regressors_.col(kBlockDamping).array() = (x1 - y1) / a_;
  regressors_.col(kBlockStiffness).array() = (x0 - y0) / a_;
  regressors_.col(kBlockDelay).array() = (b1 * x2 + b0 * x1) / a_;
  regressors_.col(kBlockGain).array() = (b1 * x1 + b0 * x0) / (own_gain * a_);
  residual = y2 / a_ - b1 * regressors_.col(kBlockDamping).array() - b0 * regressors_.col(kBlockStiffness).array();
  for (int m = 0; m < columns_.forces; ++m) {
    auto force = regressors_.col(columns_.firstForce() + m).array();
    delayed_.apply(2, block.forces.col(m), force);
    force /= a_;
    residual -= theta[columns_.firstForce() + m] * force;
    instruments_.col(columns_.firstForce() + m) = regressors_.col(columns_.firstForce() + m);
  }
  for (int m = 0; m < columns_.neighbours; ++m) {
    const int i = columns_.firstNeighbour() + m;
    regressors_.col(i).array() = block.neighbours.col(m) / a_;
    residual -= theta[i] * regressors_.col(i).array();
    instruments_.col(i).array() = block.predicted_neighbours.col(m) / a_;
  }

  const auto g2 = g_.abs2(), a2 = a_.abs2();
  rho_ = r * g2 / (r * g2 + (1.0 - r) * a2);
  rho_slope_ = g2 * a2 / (r * g2 + (1.0 - r) * a2).square();
  e_over_g_ = rho_ * residual / gain_;
  wheel_ = x0 + e_over_g_;
  auto travel = instruments_.col(kBlockStiffness).array();  // H_0 of w'' - z'' by the model, over A
  if (columns_.neighbours > 0)
    travel = (block.predicted_travel + s_ * s_ / a_ * e_over_g_) / a_;
  else
    travel = s_ * s_ / a_ * wheel_ / a_;
  instruments_.col(kBlockDamping).array() = s_ * travel;
  instruments_.col(kBlockDelay).array() = gain_ * s_ * wheel_;
  instruments_.col(kBlockGain).array() = gain_ * wheel_ / own_gain;
  instruments_.col(kBlockWheelShare).array() = -rho_slope_ / gain_.conjugate() * wheel_;
  regressors_.col(kBlockWheelShare) = instruments_.col(kBlockWheelShare);
  block.at = theta;
  block.version = ++versions_;
  for (Eigen::Index i = 0; i < p; ++i)
    if (i != kBlockWheelShare) residual += theta[i] * regressors_.col(i).array();
  sumBands(block);
}

void StrutEquations::sumBands(StrutBlock& block) const {
  const auto z = asReal(instruments_), r = asReal(regressors_);
  const Eigen::Index p = columns_.numParameters();
  for (int i = 0; i < noise_bands_.count(); ++i) {
    const int first = noise_bands_.first(i), size = noise_bands_.size(i);
    StrutBlock::Band& band = block.bands[i];
    const auto z_band = z.middleRows(2 * first, 2 * size), r_band = r.middleRows(2 * first, 2 * size);
    band.information.noalias() = z_band.transpose().lazyProduct(r_band.leftCols(p));
    band.instruments.noalias() = z_band.transpose().lazyProduct(z_band);
    band.score.noalias() = z_band.transpose().lazyProduct(r_band.col(p));
    band.share = block.at[kBlockWheelShare] * band.information.col(kBlockWheelShare);
    band.moments.noalias() = r_band.transpose().lazyProduct(r_band);
    band.powers[StrutBlock::Band::kWheel] = wheel_.segment(first, size).abs2().sum();
    band.powers[StrutBlock::Band::kBody] = block.body.col(0).segment(first, size).abs2().sum();
    band.powers[StrutBlock::Band::kMoving] = x_.col(0).segment(first, size).abs2().sum();
    const auto fourth = s_.segment(first, size).abs2().square();
    band.powers[StrutBlock::Band::kRate] = ((x_ - block.body).col(1).segment(first, size).abs2() / fourth).sum();
    band.powers[StrutBlock::Band::kTravel] = ((x_ - block.body).col(0).segment(first, size).abs2() / fourth).sum();
  }
}

BlockVector StrutEquations::start(const std::vector<const StrutBlock*>& blocks, bool with_gain) {
  // Where the gain is open the wheel has a coefficient of its own beside travel: (1 + gamma) b0 = b0 + that.
  const Eigen::Index neighbours = columns_.neighbours, gain = 2 + neighbours, p = gain + (with_gain ? 2 : 0);
  BlockMatrix normal = BlockMatrix::Zero(p, p);
  BlockVector right = BlockVector::Zero(p);
  for (const StrutBlock* block : blocks) {
    for (int i = 0; i < 2; ++i) undelayed_.apply(i, block->wheel, x_.col(i));
    regressors_.leftCols(2) << x_.col(1) - block->body.col(1), x_.col(0) - block->body.col(0);
    regressors_.middleCols(2, neighbours) = block->neighbours;
    if (with_gain) regressors_.middleCols(gain, 2) << x_.col(1), x_.col(0);
    regressors_.col(p) = block->body.col(2);
    // Over s^2: displacements, which a bounce has most of.
    regressors_.leftCols(p + 1).array().colwise() /= s_ * s_;
    const auto rows = asReal(regressors_);
    normal.noalias() += rows.leftCols(p).transpose().lazyProduct(rows.leftCols(p));
    right.noalias() += rows.leftCols(p).transpose().lazyProduct(rows.col(p));
  }
  const BlockVector scale = normal.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  const BlockMatrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  const BlockVector solution =
      scale.cwiseProduct(Eigen::PartialPivLU<BlockMatrix>(scaled).solve(scale.cwiseProduct(right)));
  BlockVector theta = BlockVector::Zero(columns_.numParameters());
  theta.head<2>() = solution.head<2>();
  theta.tail(neighbours) = solution.segment(2, neighbours);
  if (with_gain) theta[kBlockGain] = solution[gain + 1] / solution[kBlockStiffness];
  return theta;
}

}  // namespace suspension_health_monitor
