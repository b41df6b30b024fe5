#include "suspension_health_monitor/internal/identification/variable_forgetting.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kWindows = 3.0;      // of 2 L + 1 rows, in the memory
constexpr double kFewestRows = 60.0;  // of the memory
constexpr double kFarOff = 5.0;       // mean residuals

// What the rows of one window make of T alone.
double stillDrift() {
  static const double drift = std::pow(-std::expm1(-1.0 / kWindows), 2);
  return drift;
}

}  // namespace

VariableForgetting::VariableForgetting(int num_parameters, int correlated_rows, double slow, double fastest)
    : slow_(slow), fastest_(fastest), gain_(1.0 / std::max(kWindows * (correlated_rows + 1), kFewestRows)) {
  restart(num_parameters);
}

void VariableForgetting::setFactors(double slow, double fastest) {
  slow_ = slow;
  fastest_ = fastest;
}

void VariableForgetting::restart(int num_parameters) { scores_ = squares_ = Eigen::VectorXd::Zero(num_parameters); }

void VariableForgetting::add(const RegressionRow& row, double innovation, double mean_residual) {
  if (!(mean_residual > 0.0)) return;  // every row was hit
  const double ratio = innovation / mean_residual;
  const double bounded = std::abs(ratio) > kFarOff ? 0.0 : std::clamp(ratio, -1.0, 1.0);
  for (Eigen::Index i = 0; i < scores_.size(); ++i) {
    const double score = bounded * row.regressor[i];
    scores_[i] += gain_ * (score - scores_[i]);
    squares_[i] += gain_ * (score * score - squares_[i]);
  }
}

double VariableForgetting::drift() const {
  double drift = 0.0;
  for (Eigen::Index i = 0; i < scores_.size(); ++i)
    if (squares_[i] > 0.0) drift = std::max(drift, scores_[i] * scores_[i] / squares_[i]);
  return drift;
}

double VariableForgetting::factor() const {
  const double share = std::clamp(drift() / stillDrift() - 1.0, 0.0, 1.0);
  return slow_ + share * (fastest_ - slow_);
}

}  // namespace suspension_health_monitor
