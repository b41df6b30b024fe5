#include "suspension_health_monitor/internal/identification/friction_listener.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/identification/suspension_regression.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLeak = 0.5;  // over the horizon; a horizon is about as long as the strut's natural period

}  // namespace

FrictionListener::FrictionListener(const IntegralFilterOptions& filter, int delay, double forgetting_factor)
    : period_(filter.period),
      leak_(kLeak / (filter.horizon_samples * filter.period)),
      delay_(delay),
      sign_(2, filter, 2),
      column_(delay + 1),
      means_(forgetting_factor),
      moments_(forgetting_factor) {}

void FrictionListener::addSample(double relative) {
  // As after a long time of the first reading, most of which is the offset between the sensors, or gravity.
  if (!has_sample_) {
    integral_ = slow_ = relative / leak_;
    newest_ = relative;
    has_sample_ = true;
  }
  const double before = integral_ - slow_;
  integral_ += period_ * ((newest_ + relative) / 2.0 - leak_ * integral_);
  newest_ = relative;
  slow_ += period_ * leak_ * (integral_ - slow_);
  const double rate = integral_ - slow_, step = std::abs(rate - before);
  // The mean sign of a straight line over a period.
  sign_.push(rate == 0.0 ? 0.0 : std::clamp(2.0 * rate / step, -1.0, 1.0));
  column_.push(sign_.full() ? sign_.output(2) : 0.0);
}

void FrictionListener::addRow(const RegressionRow& row, double innovation, const RecursiveEstimator& estimator) {
  if (estimator.holds(kDampingToMass)) return;
  means_.add({column_.at(delay_), row.regressor[kDampingToMass], row.regressor[kStiffnessToMass]});
  const double c = column_.at(delay_) - means_.mean(kSign);
  const double damping = row.regressor[kDampingToMass] - means_.mean(kDamping);
  const double stiffness = row.regressor[kStiffnessToMass] - means_.mean(kStiffness);
  const Eigen::VectorXd& strut = estimator.parameters();
  const double output = innovation + strut[kDampingToMass] * damping + strut[kStiffnessToMass] * stiffness;
  moments_.add({c * damping, c * stiffness, c * output, c * c});
}

void FrictionListener::setForgettingFactor(double forgetting_factor) {
  means_.setForgettingFactor(forgetting_factor);
  moments_.setForgettingFactor(forgetting_factor);
}

void FrictionListener::interrupt() {
  has_sample_ = false;
  sign_.reset();
  column_.reset();
}

std::optional<DryFriction> FrictionListener::friction(const RecursiveLeastSquares& least_squares) const {
  const Eigen::Vector2d between(moments_.mean(kSignDamping), moments_.mean(kSignStiffness));
  const Eigen::Vector2d gain(least_squares.parameterShift(kDampingToMass, between),
                             least_squares.parameterShift(kStiffnessToMass, between));
  const double own = moments_.mean(kSignSquare) - between.dot(gain);
  // The residuals are as correlated beside c as beside the column of b1, of whose mean square this is what is its own.
  const double damping_own = 1.0 / least_squares.parameterShift(kDampingToMass, Eigen::Vector2d::UnitX());
  const double variance = least_squares.parameterVariance(kDampingToMass) * damping_own / own;
  if (!(own > 0.0) || !std::isfinite(variance)) return std::nullopt;
  const double left = moments_.mean(kSignOutput) - between.dot(least_squares.parameters().head<kNumStrutParameters>());
  return DryFriction{left / own, std::sqrt(variance), gain[kDampingToMass], gain[kStiffnessToMass]};
}

}  // namespace suspension_health_monitor
