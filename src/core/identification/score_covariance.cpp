#include "suspension_health_monitor/identification/score_covariance.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/identification/plain_size.h"
#include "suspension_health_monitor/signal/ring_size.h"

namespace suspension_health_monitor {
namespace {

constexpr double kMemories = 30.0;      // of the estimate, that the means last
constexpr double kLongestMemory = 1e5;  // [rows] of an estimate that never forgets
constexpr int kFirstRows = 100;         // while the estimate comes from its start
constexpr unsigned kRefreshEvery = 64;  // rows
constexpr int kStretch = 3;             // windows of lags that it looks at without a break
constexpr double kEnough = 6000.0;      // rows in the means, to rest between stretches from then on
constexpr int kRest = 7;                // stretches
constexpr double kFading = 2.0;         // the first rows, when the slow mean is still poor, count least
constexpr double kWhiteRatio = 2.0;     // of variances, before anything is known: the usual horizons give 0.5 to 3
constexpr double kSmallestShare = 0.4;  // of what uncorrelated scores would give: below, the lags' sum is mostly noise
constexpr double kFar = 5.0;            // mean sizes of a residual: beyond, a reading is wrong, or many are
// Whatever lambda, rounding and outliers that have left the window are forgotten after a thousand windows.
constexpr double kWindows = 1000.0;

}  // namespace

ScoreCovariance::ScoreCovariance(int num_parameters, int correlated_rows, double forgetting_factor)
    : size_(num_parameters),
      lags_(correlated_rows),
      forgetting_factor_(forgetting_factor),
      slow_theta_(Eigen::VectorXd::Zero(size_)),
      once_(slow_theta_),
      twice_(slow_theta_),
      score_(Eigen::VectorXd::Zero(size_)),
      lagged_(Eigen::VectorXd::Zero(size_)),
      line_(ringSize(static_cast<std::size_t>(lags_) + 1) * static_cast<std::size_t>(size_), 0.0),
      mask_(ringSize(static_cast<std::size_t>(lags_) + 1) - 1),
      first_rows_(kFirstRows),
      long_run_(Eigen::MatrixXd::Zero(size_, size_)),
      lag0_(long_run_),
      information_(long_run_),
      factor_(Eigen::MatrixXd::Identity(size_, size_)),  // without a matrix it has no state to copy
      unit_(Eigen::VectorXd::Zero(size_)),
      column_(unit_),
      unknown_(kWhiteRatio),
      prior_(Eigen::VectorXd::Constant(size_, unknown_)),
      ratio_(prior_) {
  setForgettingFactor(forgetting_factor);
}

ScoreCovariance::ScoreCovariance(const ScoreCovariance& before, const std::vector<std::optional<int>>& sources)
    : ScoreCovariance(static_cast<int>(sources.size()), before.lags_, before.forgetting_factor_) {
  slope_ = before.slope_;
  usual_ = before.usual_;
  square_ = before.square_;
  weight_ = before.weight_;
  unknown_ = before.unknown_;
  prior_.setConstant(unknown_);
  for (int i = 0; i < size_; ++i)
    if (const std::optional<int>& source = sources[static_cast<std::size_t>(i)]) prior_[i] = before.ratio_[*source];
  ratio_ = prior_;
}

void ScoreCovariance::setForgettingFactor(double forgetting_factor) {
  forgetting_factor_ = forgetting_factor;
  slow_gain_ = std::max(1.0 - forgetting_factor, 1.0 / kLongestMemory) / kMemories;
  setDecay();
}

void ScoreCovariance::setDecay() {
  const double forgetting = std::max((1.0 - forgetting_factor_) * slope_, 1.0 / (kWindows * (lags_ + 1)));
  decay_ = 1.0 - forgetting;
  end_decay_ = std::pow(decay_, lags_ + 1);
}

void ScoreCovariance::add(const RegressionRow& row, const Eigen::VectorXd& theta, const RowWeight& weight,
                          double innovation) {
  phase_ = (phase_ + 1) % kRefreshEvery;
  if (rest_ > 0) {
    --rest_;
    return;
  }
  const bool is_usual = addScore(row, weight.smallest_divisor);
  const bool counts = is_usual && (weight.smallest_divisor == 0.0 || std::abs(innovation) <= kFar * usual_);
  if (counts && in_stretch_ > lags_) average(row.regressor.data(), weight.weight, innovation);
  if (isNowAndThen() || first_rows_ > 0) nowAndThen(theta);
}

void ScoreCovariance::nowAndThen(const Eigen::VectorXd& theta) {
  const int whole = kStretch * (lags_ + kFewRows);
  if (first_rows_ == 0) in_stretch_ = std::min(in_stretch_ + kFewRows, whole);
  if (phase_ == 0) refresh();
  follow(theta);
  if (averaged_ >= kEnough && in_stretch_ == whole) endStretch();
}

// Learns what is usual, of which an outlier becomes part slowly, by kFar of it at most.
bool ScoreCovariance::isUsual(double size) {
  if (first_rows_ > 0) {
    usual_ = std::max(usual_, size);
    return true;
  }
  const double most = usual_ > 0.0 ? kFar * usual_ : size;
  usual_ += std::max(slow_gain_, kFading / (averaged_ + kFading)) * (std::min(size, most) - usual_);
  return size <= most;
}

// @return false for a row that stands out: its score is taken as 0.
bool ScoreCovariance::addScore(const RegressionRow& row, double smallest_divisor) {
  const double* const phi = row.regressor.data();
  const double* const slow = slow_theta_.data();
  double* const score = score_.data();
  double* const lagged = lagged_.data();
  const double decay = decay_, end_decay = end_decay_;
  newest_ = (newest_ + 1) & mask_;
  const std::size_t end = (newest_ + mask_ - static_cast<std::size_t>(lags_)) & mask_;
  return withPlainSize(size_, [&](auto p) {
    double* const at_newest = line_.data() + newest_ * static_cast<std::size_t>(p);
    const double* const at_end = line_.data() + end * static_cast<std::size_t>(p);
    double residual = row.output;
    for (Eigen::Index i = 0; i < p; ++i) residual -= phi[i] * slow[i];
    const double size = std::abs(residual);
    const bool counts = smallest_divisor == 0.0 || isUsual(size);
    if (!counts) residual = 0.0;
    if (smallest_divisor > 0.0) residual /= std::max(size, smallest_divisor);
    for (Eigen::Index i = 0; i < p; ++i) {
      lagged[i] = decay * (lagged[i] + score[i]) - end_decay * at_end[i];
      score[i] = residual * phi[i];
      at_newest[i] = score[i];
    }
    return counts;
  });
}

void ScoreCovariance::endStretch() {
  refresh();                                                // the next turn of it may fall into the rest
  rest_ = (kRest * in_stretch_ / kFewRows + 1) * kFewRows;  // so that the next look comes kFewRows rows after the rest
  interrupt();
}

// The slow course of the estimate by double exponential smoothing (Brown), which does not lag behind a parameter that
// moves steadily: it would take the lag for correlated noise. From when this has left its start.
void ScoreCovariance::follow(const Eigen::VectorXd& theta) {
  if (first_rows_ > 0) {
    --first_rows_;
    slow_theta_ = once_ = twice_ = theta;
    return;
  }
  const double gain = kFewRows * std::max(slow_gain_, kFading / (averaged_ + kFading * kFewRows));
  once_ += gain * (theta - once_);
  twice_ += gain * (once_ - twice_);
  slow_theta_ = 2.0 * once_ - twice_;
}

void ScoreCovariance::average(const double* regressor, double weight, double innovation) {
  averaged_ += 1.0;
  const double gain = std::max(slow_gain_, kFading / (averaged_ + kFading - 1.0));
  withPlainSize(size_, [&](auto p) {
    for (Eigen::Index j = 0; j < p; ++j) {
      for (Eigen::Index i = 0; i <= j; ++i) {
        const double now = score_[i] * score_[j];
        lag0_(i, j) += gain * (now - lag0_(i, j));
        long_run_(i, j) += gain * (now + score_[i] * lagged_[j] + lagged_[i] * score_[j] - long_run_(i, j));
        information_(i, j) += gain * (weight * regressor[i] * regressor[j] - information_(i, j));
      }
    }
  });
  square_ += gain * (weight * innovation * weight * innovation - square_);
  weight_ += gain * (weight - weight_);
}

// ratio_i = (R^-1 G R^-1)_ii / (R^-1)_ii / scale, by the columns of R^-1.
void ScoreCovariance::refresh() {
  setDecay();
  factor_.compute(information_.selfadjointView<Eigen::Upper>());
  if (factor_.info() != Eigen::Success || !(square_ > 0.0)) return;  // some parameter has not been excited yet
  // What was known before counts as some windows' rows.
  const double doubted = kFirstRows + 4.0 * lags_;
  const double trust = averaged_ * averaged_ / (averaged_ * averaged_ + doubted * doubted);
  for (int i = 0; i < size_; ++i) {
    unit_.setZero();
    unit_[i] = 1.0;
    column_ = unit_;
    factor_.solveInPlace(column_);
    double correlated = 0.0, uncorrelated = 0.0;
    for (int b = 0; b < size_; ++b) {
      for (int a = 0; a <= b; ++a) {
        const double product = (a == b ? 1.0 : 2.0) * column_[a] * column_[b];
        correlated += product * long_run_(a, b);
        uncorrelated += product * lag0_(a, b);
      }
    }
    const double found = std::max(correlated, kSmallestShare * uncorrelated) / (column_[i] * square_ / weight_);
    if (std::isfinite(found)) ratio_[i] = prior_[i] + trust * (found - prior_[i]);
  }
}

void ScoreCovariance::interrupt() {
  in_stretch_ = 0;
  std::fill(line_.begin(), line_.end(), 0.0);
  score_.setZero();
  lagged_.setZero();
}

void ScoreCovariance::beginHere() {
  if (averaged_ > kFirstRows) restart(1.0);
}

void ScoreCovariance::restart(double unit) {
  interrupt();
  first_rows_ = kFirstRows;
  rest_ = 0;
  averaged_ = 0.0;
  usual_ = square_ = weight_ = 0.0;
  unknown_ *= unit;
  ratio_ = prior_ = Eigen::VectorXd::Constant(size_, unknown_);
}

}  // namespace suspension_health_monitor
