#include "suspension_health_monitor/identification/recursive_least_absolute.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

constexpr double kSlopeMemory = 0.998;  // forgetting factor of a row in eight; a property of the noise, not the strut
constexpr double kNearZero = 0.2;       // mean absolute residuals
constexpr double kFlattest = 0.02;
constexpr double kMostUnit = 3.0;  // mean |epsilon| over scale; 2 for a normal distribution and the default divisor

}  // namespace

void LeastAbsoluteOptions::validate() const {
  if (start_rows < 1)
    throw std::invalid_argument("la/start_rows = " + std::to_string(start_rows) + ", must be at least 1");
  if (!(std::isfinite(small_divisor) && small_divisor >= 0.0))
    throw std::invalid_argument("la/small_divisor = " + std::to_string(small_divisor) + ", must be at least 0");
}

RecursiveLeastAbsolute::RecursiveLeastAbsolute(int num_parameters, const RecursiveOptions& recursive,
                                               const LeastAbsoluteOptions& options)
    : RecursiveEstimator(num_parameters, recursive), absolute_(options), slopes_(kSlopeMemory) {
  options.validate();
}

double RecursiveLeastAbsolute::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  const double innovation = innovate(row);
  if (!leads()) {
    releaseExcited(row, meanSquareResidual(), 1.0);
    correct(row, innovation, {});
    weigh(innovation);
    if (++rows_ == absolute_.start_rows) takeOver();
  } else {
    releaseExcited(row, meanAbsoluteResidual(), absolute_.scale_covariance_at_start ? meanAbsoluteResidual() : 1.0);
    const RowWeight weight = weigh(innovation);
    if (scores_.isNowAndThen()) noteSlope(innovation, weight);
    correct(row, innovation, weight);
  }
  return innovation;
}

// The weight of the row; every fourth is taken into the means of weights, since neighbours are much alike.
RowWeight RecursiveLeastAbsolute::weigh(double innovation) {
  const double smallest =
      smallestDivisor(absolute_.small_divisor_rule, absolute_.small_divisor, meanAbsoluteResidual());
  const RowWeight weight{1.0 / std::max(std::abs(innovation), smallest), smallest};
  if (scores_.isEveryFourth() && std::isfinite(weight.weight)) {
    const double score = weight.weight * innovation;
    weights_.add({score * score, weight.weight});
  }
  return weight;
}

// rho of ScoreCovariance: the weighted residual w epsilon is a straight line through 0 as far as the small divisor
// reaches and a sign beyond, so the mean of its slope is the share of rows within, over the divisor. One that is too
// small to be met in practice is replaced by a share of the scale: all that counts is the density of residuals near 0.
void RecursiveLeastAbsolute::noteSlope(double innovation, const RowWeight& weight) {
  const double within = std::max(weight.smallest_divisor, kNearZero * meanAbsoluteResidual());
  slopes_.add({std::abs(innovation) < within ? 1.0 / within : 0.0, weight.weight});
  scores_.setSlope(std::clamp(slopes_.mean(kSlope) / slopes_.mean(kSlopeWeight), kFlattest, 1.0));
}

void RecursiveLeastAbsolute::takeOver() {
  // R(k) of LA sums phi phi' / |epsilon|, that of LS phi phi': without the factor the start depends on the unit of psi.
  if (absolute_.scale_covariance_at_start && meanAbsoluteResidual() > 0.0) covariance_.scale(meanAbsoluteResidual());
  // Of the same variance: that of the mean |epsilon| for the scale. The first rows may have left it huge.
  const double unit = std::min(meanAbsoluteResidual() / scale(), kMostUnit);
  scores_.restart(unit > 0.0 ? unit : 1.0);
}

}  // namespace suspension_health_monitor
