#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/plain_text.h"

namespace suspension_health_monitor {

namespace {

constexpr double kStartMemories = 3.0;     // of rows until an estimate has left its start: so slow is LA
constexpr double kMostStartRows = 3000.0;  // for a memory that is longer

}  // namespace

void RecursiveOptions::validate() const {
  if (!(forgetting_factor > 0.0 && forgetting_factor <= 1.0))
    throw std::invalid_argument("forgetting_factor = " + numberText(forgetting_factor) + ", must be in (0, 1]");
  if (!(std::isfinite(initial_variance) && initial_variance > 0.0))
    throw std::invalid_argument("initial_variance = " + numberText(initial_variance) + ", must be above 0");
  if (correlated_rows < 0)
    throw std::invalid_argument("correlated_rows = " + std::to_string(correlated_rows) + ", must be at least 0");
}

RecursiveEstimator::RecursiveEstimator(int num_parameters, const RecursiveOptions& options)
    : options_(options),
      theta_(Eigen::VectorXd::Zero(num_parameters)),
      covariance_(num_parameters),
      scores_(num_parameters - int{options.drifting.has_value()}, std::max(0, options.correlated_rows),
              options.forgetting_factor),
      held_(static_cast<std::size_t>(num_parameters), false),
      excited_(theta_),
      best_(theta_),
      drifted_{theta_.head(num_parameters - int{options.drifting.has_value()}), 0.0},
      course_(drifted_.regressor),
      means_(options.forgetting_factor) {
  options.validate();
}

double RecursiveEstimator::innovate(const RegressionRow& row) {
  const double innovation = row.output - row.regressor.dot(theta_), size = std::abs(innovation);
  means_.add({size, innovation * innovation, std::abs(row.output), scores_.limited(size)});
  return innovation;
}

void RecursiveEstimator::learnScatter(bool estimate_is_valid, const Eigen::VectorXd& best) {
  if (!estimate_is_valid && valid_rows_ > 0.0) interrupt();
  valid_rows_ = estimate_is_valid ? valid_rows_ + 1.0 : 0.0;
  best_ = best;
}

void RecursiveEstimator::setForgettingFactor(double forgetting_factor) {
  RecursiveOptions changed = options_;
  changed.forgetting_factor = forgetting_factor;
  changed.validate();
  options_ = changed;
  means_.setForgettingFactor(forgetting_factor);
  scores_.setForgettingFactor(forgetting_factor);
}

void RecursiveEstimator::correct(const RegressionRow& row, double innovation, const RowWeight& weight) {
  const double lambda = options_.forgetting_factor;
  // Rows that are held in part say nothing of how residuals of whole ones are correlated.
  const bool has_settled = valid_rows_ > std::min(kStartMemories / (1.0 - lambda), kMostStartRows);
  const bool is_whole = !holdsAny();
  if (is_whole && has_settled && !learn(row, innovation, weight)) valid_rows_ = 0.0;
  const Eigen::VectorXd& gain =
      is_whole ? covariance_.update(row.regressor, lambda / weight.weight, lambda) : correctPartly(row, weight.weight);
  theta_ += gain * innovation;
}

// An offset that drifts is followed from row to row; a slow course of it would lag.
bool RecursiveEstimator::learn(const RegressionRow& row, double innovation, const RowWeight& weight) {
  if (!options_.drifting) return scores_.add(row, best_, weight, innovation);
  const int level = numScores() - 1;
  drifted_.regressor = row.regressor.head(numScores());
  drifted_.output = row.output;
  drifted_.regressor[*options_.drifting] += row.regressor.tail(2).dot(best_.tail(2)) / best_[*options_.drifting];
  course_ = best_.head(numScores());
  course_[level] = 0.0;
  return scores_.add(drifted_, course_, weight, innovation);
}

// @return the gain for a row of which only the part that is not held counts.
const Eigen::VectorXd& RecursiveEstimator::correctPartly(const RegressionRow& row, double weight) {
  for (int i = 0; i < numParameters(); ++i) excited_[i] = holds(i) ? 0.0 : row.regressor[i];
  covariance_.forgetAlong(excited_, options_.forgetting_factor);
  return covariance_.update(excited_, 1.0 / weight, 1.0);
}

void RecursiveEstimator::hold(int i, bool held) { held_[static_cast<std::size_t>(i)] = held; }

void RecursiveEstimator::release(const Eigen::VectorXd& regressor, double residual_variance, double unit) {
  for (int i = 0; i < numParameters(); ++i) {
    if (covariance_.isReleased(i) || regressor[i] == 0.0) continue;
    const bool relative = options_.initial_variance_rule == InitialVariance::kRelative;
    if (theta_[i] != 0.0 && residual_variance > 0.0)
      covariance_.release(i, theta_[i] * theta_[i] / residual_variance);
    else
      covariance_.release(i, unit * options_.initial_variance / (relative ? regressor[i] * regressor[i] : 1.0));
    ++num_released_;
  }
}

void RecursiveEstimator::changeColumns(const std::vector<ColumnOrigin>& columns) {
  const Eigen::VectorXd before = theta_;
  theta_.resize(static_cast<Eigen::Index>(columns.size()));
  std::vector<std::optional<int>> sources;
  for (const ColumnOrigin& column : columns) {
    theta_[static_cast<Eigen::Index>(sources.size())] = column.before ? before[*column.before] : column.start;
    sources.push_back(column.before);
  }
  covariance_ = UdCovariance(covariance_, sources);
  held_.assign(columns.size(), false);  // the plain strut's own are held anew when its excitation is judged
  excited_ = best_ = theta_;
  drifted_.regressor = course_ = theta_.head(numScores());
  if (options_.drifting) sources.pop_back();
  scores_ = ScoreCovariance(scores_, sources);
  num_released_ = 0;
  for (int i = 0; i < numParameters(); ++i) num_released_ += covariance_.isReleased(i) ? 1 : 0;
}

double RecursiveLeastSquares::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  drift();
  const double innovation = innovate(row);
  releaseExcited(row, meanSquareResidual(), 1.0);
  correct(row, innovation, {});
  return innovation;
}

}  // namespace suspension_health_monitor
