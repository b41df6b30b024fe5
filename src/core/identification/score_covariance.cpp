#include "suspension_health_monitor/internal/identification/score_covariance.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr int kFewestRows = 32;          // of a block, where rows are hardly correlated
constexpr double kFewestBlocks = 50.0;   // that the means last: chance then makes 20 % of a variance, 10 % of a stddev
constexpr double kMemories = 30.0;       // of the estimate, that the means last if that is longer
constexpr double kMostBlocks = 1e4;      // that they last for an estimate that never forgets
constexpr double kFading = 2.0;          // the first blocks, when the slow course is still poor, count least
constexpr double kPriorBlocks = 6.0;     // that what is assumed beforehand counts for
constexpr double kWhiteRatio = 2.0;      // of variances, assumed beforehand: the usual horizons give 0.5 to 3
constexpr double kSmallestShare = 0.4;   // of A: if its sum with the neighbours' part is smaller, that is chance
constexpr double kMostDeviations = 3.0;  // of a sum of scores of a block: chance exceeds it once in 300 blocks
constexpr int kMostStrange = 2;          // blocks in a row, most rows of which stand out
constexpr double kFar = 5.0;             // mean sizes of a residual: beyond, a reading is wrong, or many are

// m <- m + factor a b', the lower triangle.
void addProduct(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double factor, Eigen::MatrixXd& m) {
  for (Eigen::Index j = 0; j < a.size(); ++j)
    for (Eigen::Index i = j; i < a.size(); ++i) m(i, j) += factor * a[i] * b[j];
}

// x' m x of a symmetric matrix whose lower triangle is given.
double quadratic(const Eigen::MatrixXd& m, const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    sum += m(j, j) * x[j] * x[j];
    for (Eigen::Index i = j + 1; i < x.size(); ++i) sum += 2.0 * m(i, j) * x[i] * x[j];
  }
  return sum;
}

}  // namespace

ScoreCovariance::Rows::Rows(int num_parameters, double forgetting_factor)
    : scores(Eigen::VectorXd::Zero(num_parameters)),
      information(Eigen::MatrixXd::Zero(num_parameters, num_parameters)),
      decay(forgetting_factor) {}

void ScoreCovariance::Rows::clear() {
  scores.setZero();
  information.setZero();
  squares = weight = 0.0;
  usual = all = 0;
}

ScoreCovariance::ScoreCovariance(int num_parameters, int correlated_rows, double forgetting_factor)
    : block_rows_(std::max(correlated_rows + 1, kFewestRows)),
      forgetting_factor_(forgetting_factor),
      course_(Eigen::MatrixXd::Zero(num_parameters, 2)),
      block_(num_parameters, forgetting_factor),
      before_{block_.scores},
      means_{block_.information, block_.information, block_.information},
      work_{Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd::Identity(num_parameters, num_parameters)),  // else no copy
            block_.scores},
      prior_(Eigen::VectorXd::Constant(num_parameters, kWhiteRatio)),
      ratio_(prior_) {}

ScoreCovariance::ScoreCovariance(const ScoreCovariance& before, const std::vector<std::optional<int>>& sources)
    : ScoreCovariance(static_cast<int>(sources.size()), before.block_rows_ - 1, before.forgetting_factor_) {
  slope_ = before.slope_;
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (sources[i]) prior_[static_cast<Eigen::Index>(i)] = before.ratio_[*sources[i]];
  ratio_ = prior_;
}

void ScoreCovariance::interrupt() {
  block_.clear();
  before_.is_known = false;
}

void ScoreCovariance::restart() {
  interrupt();
  usual_ = {};
  means_.blocks = 0.0;
  strange_blocks_ = 0;
  ratio_ = prior_;
}

double ScoreCovariance::longestMemory() const {
  const double memory = 1.0 / std::max((1.0 - forgetting_factor_) * block_rows_, 1e-12);
  return std::clamp(kMemories * memory, kFewestBlocks, kMostBlocks);
}

bool ScoreCovariance::add(const RegressionRow& row, const Eigen::VectorXd& theta, const RowWeight& weight,
                          double innovation) {
  if (usual_.rows == 0.0) course_.colwise() = theta;
  const double residual = row.output - 2.0 * row.regressor.dot(course_.col(0)) + row.regressor.dot(course_.col(1));
  block_.scores *= block_.decay;
  ++block_.all;
  if (isUsual(residual, innovation)) {
    const bool by_residual = weight.smallest_divisor > 0.0;
    const double of_residual =
        by_residual ? 1.0 / std::max(std::abs(residual), weight.smallest_divisor) : weight.weight;
    const double step = weight.weight * innovation;
    block_.scores += (of_residual * residual) * row.regressor;
    addProduct(row.regressor, row.regressor, weight.weight, block_.information);
    block_.squares += step * step;
    block_.weight += weight.weight;
    ++block_.usual;
  }
  return block_.all < block_rows_ || closeBlock(theta);
}

// Also learns what is usual, of which an outlier becomes part slowly, by kFar of it at most.
bool ScoreCovariance::isUsual(double residual, double innovation) {
  const double size = std::abs(residual);
  if (usual_.mean == 0.0) usual_.mean = size;
  const double most = kFar * usual_.mean;
  usual_.rows = std::min(usual_.rows + 1.0, longestMemory() * block_rows_);
  usual_.mean += (std::min(size, most) - usual_.mean) / usual_.rows;
  return size <= most && std::abs(innovation) <= most;
}

double ScoreCovariance::limited(double size) const {
  return usual_.mean > 0.0 ? std::min(size, kFar * usual_.mean) : size;
}

bool ScoreCovariance::closeBlock(const Eigen::VectorXd& theta) {
  if (2 * block_.usual < block_.all) {
    // A wrong reading is in two blocks; if there are more, what was usual is not any more.
    const int strange = strange_blocks_ + 1;
    if (strange <= kMostStrange) {
      interrupt();
      strange_blocks_ = strange;
      return true;
    }
    prior_ = ratio_;
    restart();
    return false;
  }
  strange_blocks_ = 0;
  if (before_.is_known) {
    limitScores();
    means_.blocks += 1.0;
    const double gain = std::max(1.0 / longestMemory(), kFading / (means_.blocks + kFading - 1.0));
    average(gain);
    compareWithWhiteResiduals();
    // Double exponential smoothing (Brown), which does not lag behind a parameter that moves steadily: it would take
    // the lag for correlated noise.
    course_.col(0) += gain * (theta - course_.col(0));
    course_.col(1) += gain * (course_.col(0) - course_.col(1));
  } else if (means_.blocks == 0.0) {
    course_.colwise() = theta;  // the first block, in which the estimate may still come from its start, tells no more
  }
  before_.scores = block_.scores;
  before_.is_known = true;
  block_.clear();
  block_.decay = 1.0 - (1.0 - forgetting_factor_) * slope_;
  return true;
}

// The end of a wrong reading's rows does not stand out row by row, but all are of one sign.
void ScoreCovariance::limitScores() {
  if (means_.blocks < kPriorBlocks) return;
  double most = 0.0;  // standard deviations
  for (Eigen::Index i = 0; i < block_.scores.size(); ++i)
    if (means_.own(i, i) > 0.0) most = std::max(most, std::abs(block_.scores[i]) / std::sqrt(means_.own(i, i)));
  if (most > kMostDeviations) block_.scores *= kMostDeviations / most;
}

void ScoreCovariance::average(double gain) {
  const double rows = block_.usual;
  means_.own *= 1.0 - gain;
  addProduct(block_.scores, block_.scores, gain, means_.own);
  means_.neighbours *= 1.0 - gain;
  addProduct(block_.scores, before_.scores, gain, means_.neighbours);
  addProduct(before_.scores, block_.scores, gain, means_.neighbours);
  means_.information *= 1.0 - gain;
  means_.information += (gain / rows) * block_.information;
  means_.square += gain * (block_.squares / rows - means_.square);
  means_.weight += gain * (block_.weight / rows - means_.weight);
}

// ratio_i = (R^-1 G R^-1)_ii / (R^-1)_ii / scale, by the columns of R^-1; all of one row, so that G is over what it
// would be of one row for white scores, sum mu^2j over a block.
void ScoreCovariance::compareWithWhiteResiduals() {
  work_.factor.compute(means_.information);
  if (work_.factor.info() != Eigen::Success || !(means_.square > 0.0))
    return;  // some parameter has not been excited yet
  const double of_block = std::pow(block_.decay, block_rows_);
  const double rows =
      block_.decay < 1.0 ? (1.0 - of_block * of_block) / (1.0 - block_.decay * block_.decay) : block_rows_;
  const double trust = means_.blocks * means_.blocks / (means_.blocks * means_.blocks + kPriorBlocks * kPriorBlocks);
  for (Eigen::Index i = 0; i < ratio_.size(); ++i) {
    work_.column.setZero();
    work_.column[i] = 1.0;
    work_.factor.solveInPlace(work_.column);
    const double own = quadratic(means_.own, work_.column), of_neighbours = quadratic(means_.neighbours, work_.column);
    const double correlated = std::max(own + of_block * of_neighbours, kSmallestShare * own) / rows;
    const double found = correlated / (work_.column[i] * means_.square / means_.weight);
    if (std::isfinite(found)) ratio_[i] = prior_[i] + trust * (found - prior_[i]);
  }
}

bool ScoreCovariance::isKnown() const { return means_.blocks > kPriorBlocks; }

double ScoreCovariance::inflation(int i, double weight) const {
  const double forgetting = 1.0 - forgetting_factor_;
  // The weight of a memory that was longer still counts for a while.
  return ratio_[i] * (2.0 - std::min(1.0, forgetting * weight)) / (slope_ * (2.0 - forgetting * slope_));
}

}  // namespace suspension_health_monitor
