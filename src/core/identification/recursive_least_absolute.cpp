#include "suspension_health_monitor/internal/identification/recursive_least_absolute.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/plain_text.h"

namespace suspension_health_monitor {
namespace {

// Forgetting factor of the slope, which is a property of the noise and not of the strut; 1 % of it is chance then.
constexpr double kSlopeMemory = 0.9998;
constexpr double kNearZero = 0.2;  // mean absolute residuals
constexpr double kFlattest = 0.02;

}  // namespace

void LeastAbsoluteOptions::validate() const {
  if (start_rows < 1)
    throw std::invalid_argument("start_rows = " + std::to_string(start_rows) + ", must be at least 1");
  if (!(std::isfinite(small_divisor) && small_divisor >= 0.0))
    throw std::invalid_argument("small_divisor = " + numberText(small_divisor) + ", must be at least 0");
}

RecursiveLeastAbsolute::RecursiveLeastAbsolute(int num_parameters, const RecursiveOptions& recursive,
                                               const LeastAbsoluteOptions& options)
    : RecursiveEstimator(num_parameters, recursive),
      absolute_(options),
      weights_(recursive.forgetting_factor),
      slopes_(kSlopeMemory) {
  options.validate();
}

double RecursiveLeastAbsolute::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  drift();
  const double innovation = innovate(row);
  const RowWeight weight = weigh(innovation);
  if (!leads()) {
    releaseExcited(row, meanSquareResidual(), 1.0);
    correct(row, innovation, {});
    if (++rows_ == absolute_.start_rows) takeOver();
  } else {
    releaseExcited(row, meanAbsoluteResidual(), absolute_.scale_covariance_at_start ? meanAbsoluteResidual() : 1.0);
    correct(row, innovation, weight);
  }
  return innovation;
}

// Also learns rho of ScoreCovariance: the weighted residual w epsilon is a straight line through 0 as far as the small
// divisor reaches and a sign beyond, so the mean of its slope is the share of rows within, over the divisor. One that
// is too small to be met in practice is replaced by a share of the scale: all that counts is the density of residuals
// near 0.
RowWeight RecursiveLeastAbsolute::weigh(double innovation) {
  const double size = std::abs(innovation);
  const double smallest =
      smallestDivisor(absolute_.small_divisor_rule, absolute_.small_divisor, meanAbsoluteResidual());
  const RowWeight weight{1.0 / std::max(size, smallest), smallest};
  if (!std::isfinite(weight.weight)) return weight;
  const double score = weight.weight * innovation;
  weights_.setForgettingFactor(forgettingFactor());
  weights_.add({score * score, weight.weight});
  const double within = std::max(smallest, kNearZero * meanAbsoluteResidual());
  slopes_.add({size < within ? 1.0 / within : 0.0, weight.weight});
  if (leads()) scores_.setSlope(std::clamp(slopes_.mean(0) / slopes_.mean(1), kFlattest, 1.0));
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
  scores_.restart();  // they are weighted from now on
}

}  // namespace suspension_health_monitor
