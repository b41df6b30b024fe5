#include "suspension_health_monitor/internal/identification/horizon_survey.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr int kShortest = 6;
constexpr int kFewestRows = 20;
const double kStep = std::sqrt(2.0);

}  // namespace

HorizonSurvey::HorizonSurvey(double period, IntegrationRule rule, int longest) : period_(period) {
  for (double exact = kShortest; exact < longest + 0.5; exact *= kStep) {
    const int even = 2 * static_cast<int>(std::lround(exact / 2));
    if (!candidates_.empty() && candidates_.back().horizon_samples == even) continue;
    candidates_.push_back({even, SuspensionRegression({even, period, rule})});
  }
}

void HorizonSurvey::push(const CornerSample& sample) {
  for (Candidate& candidate : candidates_) {
    const RegressionRow* row = candidate.regression.push(sample);
    if (row == nullptr) continue;
    const Eigen::Vector3d entries(row->regressor[kDampingToMass], row->regressor[kStiffnessToMass], row->output);
    ++candidate.rows;
    const Eigen::Vector3d off = entries - candidate.means;
    candidate.means += off / static_cast<double>(candidate.rows);
    candidate.moments += off * (entries - candidate.means).transpose();  // Welford
  }
}

void HorizonSurvey::interrupt() {
  for (Candidate& candidate : candidates_) candidate.regression.reset();
}

bool HorizonSurvey::Candidate::hasEnough() const { return rows >= kFewestRows; }

Eigen::Vector2d HorizonSurvey::Candidate::theta() const {
  return moments.topLeftCorner<2, 2>().inverse() * moments.topRightCorner<2, 1>();
}

std::optional<HorizonSurvey::Choice> HorizonSurvey::choose() const {
  std::optional<Choice> best;
  for (const Candidate& candidate : candidates_) {
    const Eigen::Vector2d theta = candidate.theta();
    if (!candidate.hasEnough() || !theta.allFinite() || theta.minCoeff() <= 0.0) continue;
    const double proposed = proposeHorizon(theta[kDampingToMass], theta[kStiffnessToMass]).horizon;
    const double distance = std::abs(std::log(proposed / (candidate.horizon_samples * period_)));
    if (!best || distance < best->distance) best = Choice{&candidate, proposed, distance};
  }
  return best;
}

std::optional<HorizonSurvey::Result> HorizonSurvey::result() const {
  const std::optional<Choice> choice = choose();
  if (!choice) return std::nullopt;
  const Eigen::Matrix3d& moments = choice->candidate->moments;
  const Eigen::Vector2d theta = choice->candidate->theta();
  return Result{suspension_health_monitor::horizonSamples(choice->horizon, period_), theta[kDampingToMass],
                theta[kStiffnessToMass], theta.dot(moments.topRightCorner<2, 1>()) / moments(2, 2)};
}

std::optional<int> HorizonSurvey::horizonSamples() const {
  const std::optional<Result> proposed = result();
  if (!proposed) return std::nullopt;
  return proposed->horizon_samples;
}

bool HorizonSurvey::isClear() const {
  const std::optional<Choice> choice = choose();
  return choice && choice->distance <= std::log(kStep) && result()->explained >= kClear;
}

bool HorizonSurvey::dampingIsNegative() const {
  bool any = false;
  const bool all = std::all_of(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
    if (!candidate.hasEnough()) return true;
    any = true;
    return candidate.theta()[kDampingToMass] < 0.0;
  });
  return any && all;
}

HorizonSurvey surveyOf(const std::vector<Drive>& drives, double period, std::size_t most_samples) {
  HorizonSurvey survey(period, IntegralFilterOptions{}.rule, HorizonSurvey::kLongest);
  for (const Drive& drive : drives) {
    const CornerSample* last = nullptr;
    for (std::size_t k = 0; k < std::min(most_samples, drive.samples.size()); ++k) {
      const CornerSample& sample = drive.samples[k];
      const bool usable = isUsable(sample.sprung_acceleration) && isUsable(sample.unsprung_acceleration);
      if (!usable || last == nullptr ||
          continuity(sample.stamp - last->stamp, fromSeconds(period)) != Continuity::kContinues)
        survey.interrupt();
      if (usable) survey.push(sample);
      last = &sample;
    }
  }
  return survey;
}

std::optional<int> surveyHorizon(const std::vector<Drive>& drives, double period, std::size_t most_samples) {
  return surveyOf(drives, period, most_samples).horizonSamples();
}

}  // namespace suspension_health_monitor
