#include "suspension_health_monitor/identification/horizon_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "suspension_health_monitor/identification/horizon_selection.h"

namespace suspension_health_monitor {
namespace {

constexpr int kShortest = 6;  // even, for Simpson's rule, and enough for the cubic one
constexpr double kFewestRows = 20;

}  // namespace

HorizonSurvey::HorizonSurvey(double period, IntegrationRule rule, int longest) : period_(period), rule_(rule) {
  RecursiveOptions options;
  options.forgetting_factor = 1.0;
  for (double exact = kShortest; exact < longest + 0.5; exact *= std::sqrt(2.0)) {
    const int even = 2 * static_cast<int>(std::lround(exact / 2));
    if (!candidates_.empty() && candidates_.back().horizon_samples == even) continue;
    candidates_.push_back(
        {even, SuspensionRegression({even, period, rule}), RecursiveLeastSquares(kNumStrutParameters, options)});
  }
}

void HorizonSurvey::push(const CornerSample& sample) {
  for (Candidate& candidate : candidates_)
    if (const RegressionRow* row = candidate.regression.push(sample)) candidate.least_squares.update(*row);
}

void HorizonSurvey::interrupt() {
  for (Candidate& candidate : candidates_) candidate.regression.reset();
}

std::optional<int> HorizonSurvey::horizonSamples() const {
  std::optional<int> best;
  double smallest_distance = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates_) {
    const Eigen::VectorXd& theta = candidate.least_squares.parameters();
    const bool is_strut = theta[kDampingToMass] > 0.0 && theta[kStiffnessToMass] > 0.0 && theta.allFinite();
    if (candidate.least_squares.effectiveRows() < kFewestRows || !is_strut) continue;
    const double proposed = proposeHorizon(theta[kDampingToMass], theta[kStiffnessToMass]).horizon;
    const double distance = std::abs(std::log(proposed / (candidate.horizon_samples * period_)));
    if (distance >= smallest_distance) continue;
    smallest_distance = distance;
    best = suspension_health_monitor::horizonSamples(proposed, period_, rule_);
  }
  return best;
}

bool HorizonSurvey::dampingIsNegative() const {
  bool any = false;
  const bool all = std::all_of(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
    if (candidate.least_squares.effectiveRows() < kFewestRows) return true;
    any = true;
    return candidate.least_squares.parameters()[kDampingToMass] < 0.0;
  });
  return any && all;
}

}  // namespace suspension_health_monitor
