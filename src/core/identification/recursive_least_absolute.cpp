#include "suspension_health_monitor/internal/identification/recursive_least_absolute.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

RecursiveLeastAbsolute::RecursiveLeastAbsolute(int num_parameters, const RecursiveOptions& recursive,
                                               const LeastAbsoluteOptions& options)
    : RecursiveEstimator(num_parameters, recursive), absolute_(options), weights_(recursive.forgetting_factor) {}

double RecursiveLeastAbsolute::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  drift();
  const double innovation = innovate(row);
  const double weight = weigh(innovation);
  if (!leads()) {
    releaseExcited(row, meanSquareResidual(), 1.0);
    correct(row, innovation, 1.0);
    if (++rows_ == absolute_.start_rows) takeOver();
  } else {
    releaseExcited(row, meanAbsoluteResidual(), absolute_.scale_covariance_at_start ? meanAbsoluteResidual() : 1.0);
    correct(row, innovation, weight);
  }
  return innovation;
}

double RecursiveLeastAbsolute::weigh(double innovation) {
  const double smallest =
      smallestDivisor(absolute_.small_divisor_rule, absolute_.small_divisor, meanAbsoluteResidual());
  const double weight = 1.0 / std::max(std::abs(innovation), smallest);
  if (!std::isfinite(weight)) return weight;
  const double score = weight * innovation;
  weights_.setForgettingFactor(forgettingFactor());
  weights_.add({score * score, weight});
  return weight;
}

void RecursiveLeastAbsolute::beginAgain(const RecursiveLeastSquares& least_squares) {
  static_cast<RecursiveEstimator&>(*this) = least_squares;
  weights_ = RunningMeans<kNumMeans>(forgettingFactor());
  rows_ = absolute_.start_rows;
  takeOver();
}

void RecursiveLeastAbsolute::takeOver() {
  // R(k) of LA sums phi phi' / |epsilon|, that of LS phi phi': without the factor the start depends on the unit of psi.
  if (absolute_.scale_covariance_at_start && meanAbsoluteResidual() > 0.0) covariance_.scale(meanAbsoluteResidual());
  scatter_.interrupt();  // rows are weighted from now on
}

}  // namespace suspension_health_monitor
