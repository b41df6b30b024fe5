#include "suspension_health_monitor/internal/fit/initial_states.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"

namespace suspension_health_monitor {
namespace {

constexpr double kTimeConstants = 10.0;
constexpr int kMostSteps = 6;
constexpr double kStateStep = 1e-4;  // of the drive's size
constexpr double kConverged = 1e-6;  // of the residual

/// The part of a segment that remembers its start.
DriveSegment beginning(const DriveSegment& segment, const StrutModel& model) {
  const double half = 0.5 * model.damping_to_mass;
  const double root = std::sqrt(std::max(0.0, half * half - model.stiffness_to_mass));
  const double samples = std::ceil(kTimeConstants / (half - root) / segment.period);
  const auto kept = static_cast<std::size_t>(std::clamp(samples, 8.0, static_cast<double>(segment.size())));
  const std::size_t steps = (kept - 1 + 2 * segment.lead()) * static_cast<std::size_t>(segment.steps);
  DriveSegment head;
  head.start = segment.start;
  head.driven_before = segment.driven_before;
  head.period = segment.period;
  head.steps = segment.steps;
  head.taps = segment.taps;
  head.sprung.assign(segment.sprung.begin(), segment.sprung.begin() + static_cast<std::ptrdiff_t>(kept));
  head.wheel.assign(segment.wheel.begin(), segment.wheel.begin() + static_cast<std::ptrdiff_t>(steps));
  return head;
}

/// @return measured - predicted; nothing if the model runs away.
std::optional<Eigen::VectorXd> residualsFrom(const StrutState& state, const StrutModel& model,
                                             const DriveSegment& segment) {
  std::vector<double> predicted;
  if (!runFree(model, segment, state, predicted)) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(segment.size());
  return Eigen::Map<const Eigen::VectorXd>(segment.sprung.data(), count) -
         Eigen::Map<const Eigen::VectorXd>(predicted.data(), count);
}

/// Change of the residuals per unit of either state, by forward differences.
std::optional<Eigen::MatrixXd> sensitivities(const StrutState& state, const Eigen::VectorXd& residuals,
                                             const Eigen::Vector2d& steps, const StrutModel& model,
                                             const DriveSegment& segment) {
  Eigen::MatrixXd columns(residuals.size(), 2);
  for (int i = 0; i < 2; ++i) {
    StrutState moved = state;
    (i == 0 ? moved.travel : moved.travel_rate) += steps[i];
    const std::optional<Eigen::VectorXd> changed = residualsFrom(moved, model, segment);
    if (!changed) return std::nullopt;
    columns.col(i) = (*changed - residuals) / steps[i];
  }
  return columns;
}

std::optional<StrutState> estimate(const StrutModel& model, const DriveSegment& segment) {
  StrutState state;
  std::optional<Eigen::VectorXd> residuals = residualsFrom(state, model, segment);
  if (!residuals) return std::nullopt;
  const double size = Eigen::Map<const Eigen::VectorXd>(segment.sprung.data(), residuals->size()).norm() /
                      std::sqrt(static_cast<double>(residuals->size()));
  if (size == 0.0) return state;
  const Eigen::Vector2d steps =
      kStateStep * size * Eigen::Vector2d(1.0 / model.stiffness_to_mass, 1.0 / std::sqrt(model.stiffness_to_mass));
  for (int i = 0; i < kMostSteps; ++i) {
    const auto columns = sensitivities(state, *residuals, steps, model, segment);
    if (!columns) break;
    const Eigen::Vector2d change = columns->colPivHouseholderQr().solve(-*residuals);
    StrutState next = state;
    next.travel += change[0];
    next.travel_rate += change[1];
    const std::optional<Eigen::VectorXd> left = residualsFrom(next, model, segment);
    if (!left || !(left->norm() < residuals->norm())) break;
    const bool converged = left->norm() > (1.0 - kConverged) * residuals->norm();
    state = next;
    residuals = left;
    if (converged) break;
  }
  return state;
}

}  // namespace

std::optional<std::vector<StrutState>> estimateInitialStates(const Records& records, const StrutModel& model) {
  std::vector<StrutState> states;
  for (const DriveSegment* segment : segmentsOf(records)) {
    const std::optional<StrutState> state = estimate(model, beginning(*segment, model));
    if (!state) return std::nullopt;
    states.push_back(*state);
  }
  return states;
}

}  // namespace suspension_health_monitor
