#include "suspension_health_monitor/internal/fit/output_error_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "parameterization.h"
#include "segment_cost.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

using LocalStates = std::vector<std::array<double, 2>>;  // travel and travel rate that segments begin with, scaled

/// @return nothing if an effect never acts in these drives, or a fault of the measurement cannot show in them.
std::optional<std::vector<double>> coefficientScales(const StrutModel& start, const DriveSizes& sizes) {
  std::vector<double> scales;
  for (const double force : sizes.forces) {
    if (force == 0.0) return std::nullopt;
    scales.push_back(kSmall * sizes.reading.y / force);  // a coefficient of 1 makes a tenth of the acceleration
  }
  for (const ActiveMeasurementEffect& reading : start.reading) {
    bool shows = false;
    for (std::size_t i = 0; i < reading.coefficients.size(); ++i) {
      const double scale = reading.effect.scale(sizes.reading, i);
      shows = shows || std::isfinite(scale);
      scales.push_back(std::isfinite(scale) ? scale : 1.0);  // nothing moves the coefficient of a channel that is empty
    }
    if (!shows) return std::nullopt;
  }
  return scales;
}

/// Standard deviations of the model's numbers (in SI), the initial states of the segments being unknown, too.
std::vector<double> standardDeviations(const ceres::Problem& problem, const Parameterization& parameters,
                                       const double* model) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(parameters.size(), parameters.size());
  double square = 0.0, count = 0.0;
  std::vector<ceres::ResidualBlockId> blocks;
  problem.GetResidualBlocks(&blocks);
  for (const ceres::ResidualBlockId block : blocks) {
    std::vector<double*> x;
    problem.GetParameterBlocksForResidualBlock(block, &x);
    const ceres::CostFunction* cost = problem.GetCostFunctionForResidualBlock(block);
    Eigen::VectorXd residuals(cost->num_residuals());
    RowMajor shared(cost->num_residuals(), parameters.size()), local(cost->num_residuals(), 2);
    double* jacobians[2] = {shared.data(), local.data()};
    if (!cost->Evaluate(x.data(), residuals.data(), jacobians)) continue;
    const Eigen::MatrixXd cross = local.transpose() * shared;
    information += shared.transpose() * shared - cross.transpose() * solveSymmetric(local.transpose() * local, cross);
    square += residuals.squaredNorm();
    count += static_cast<double>(residuals.size());
  }
  const Eigen::MatrixXd covariance =
      square / count * solveSymmetric(information, Eigen::MatrixXd::Identity(parameters.size(), parameters.size()));
  const Eigen::VectorXd deviations =
      covariance.diagonal().cwiseMax(0.0).cwiseSqrt().cwiseProduct(parameters.slopes(model).cwiseAbs());
  return {deviations.data(), deviations.data() + deviations.size()};
}

/// Fits the model `x` and the initial states in place.
/// @param holds_model  it stays as it is.
/// @return false if the solver fails.
bool solve(ceres::Problem& problem, bool holds_model, Eigen::VectorXd& x, LocalStates& initial) {
  auto* ordering = new ceres::ParameterBlockOrdering;  // the solver's options own it
  ceres::Solver::Options solver;
  solver.linear_solver_ordering.reset(ordering);
  for (auto& of_segment : initial) ordering->AddElementToGroup(of_segment.data(), 0);
  ordering->AddElementToGroup(x.data(), 1);
  if (holds_model) problem.SetParameterBlockConstant(x.data());
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.max_num_iterations = 25;
  solver.function_tolerance = 1e-7;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable();
}

/// A first guess of coefficients by linear thinking may make the model run away: they are halved until it does not.
/// @return false if that does not help.
bool tame(const Segments& segments, const std::vector<StrutState>& initial, StrutModel& model) {
  constexpr int most_halvings = 4;
  for (int halved = 0; !freeRunResiduals(model, segments, initial); ++halved) {
    if (halved == most_halvings) return false;
    for (ActiveEffect& active : model.effects) active.coefficient /= 2.0;
  }
  return true;
}

/// Adds initial states and residuals.
/// @param states  travel and travel rate that the segments begin with.
bool addResiduals(const Segments& segments, std::vector<StrutState> states, ModelFit& fit) {
  carryMemories(fit.model, segments, states);
  std::optional<Residuals> residuals = freeRunResiduals(fit.model, segments, states);
  if (!residuals) return false;
  fit.residuals = std::move(*residuals);
  fit.initial = std::move(states);
  return true;
}

template <class Value>
void cutEnds(std::size_t count, std::vector<Value>& values) {
  values.resize(values.size() - count);
  values.erase(values.begin(), values.begin() + count);
}

}  // namespace

bool runFree(const StrutModel& model, const DriveSegment& segment, StrutState state, std::vector<double>& predicted,
             std::vector<StrutState>* motion) {
  double largest = 0.0;
  for (const double y : segment.sprung) largest = std::max(largest, std::abs(y));
  const std::size_t lead = segment.lead();
  const RecordedWheel wheel{segment.wheel, segment.timeDriven(0) - static_cast<double>(lead) * segment.period,
                            segment.period, segment.steps, segment.size() + 2 * lead};
  if (!FreeRun::follow(model, wheel, state, kRunaway * largest, predicted, motion)) return false;
  passLow(segment.taps, predicted);
  cutEnds(lead, predicted);
  if (motion != nullptr) cutEnds(lead, *motion);
  model.read(segment.body, segment.period, predicted);
  return true;
}

std::optional<Residuals> freeRunResiduals(const StrutModel& model, const Segments& segments,
                                          const std::vector<StrutState>& initial) {
  Residuals all;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::vector<double>& residuals = all.emplace_back();
    if (!runFree(model, *segments[s], initial[s], residuals)) return std::nullopt;
    for (std::size_t k = 0; k < residuals.size(); ++k) residuals[k] = segments[s]->sprung[k] - residuals[k];
  }
  return all;
}

FitOutcome fitOutputError(const Records& records, const std::vector<SampleMask>& masks, const StrutModel& guess,
                          const std::vector<StrutState>& guessed_states) {
  const Segments segments = segmentsOf(records);
  StrutModel start = guess;
  std::vector<StrutState> states = guessed_states;
  states.resize(segments.size());
  if (!(start.stiffness_to_mass > 0.0)) return FitFailure::kNoSpring;
  if (!tame(segments, states, start)) return FitFailure::kRunsAway;
  const std::optional<DriveSizes> sizes = measureSizes(segments, masks, start);
  if (!sizes) return FitFailure::kRunsAway;
  const auto coefficient_scales = coefficientScales(start, *sizes);
  if (!coefficient_scales) return FitFailure::kNeverActs;
  const MotionScale& scale = sizes->motion;
  const Parameterization parameters(start, *coefficient_scales, scale);
  const double outlier = std::max(kOutlierScale * sizes->reading.residual, 1e-9 * sizes->reading.y);
  Eigen::VectorXd x = parameters.initial();
  LocalStates initial(segments.size(), {0.0, 0.0});
  for (std::size_t s = 0; s < guessed_states.size(); ++s)
    initial[s] = {states[s].travel / scale.travel, states[s].travel_rate / scale.travel_rate};
  for (StrutState& state : states) state.memory = {};
  CarriedMemories memories(segments, states);
  ceres::Problem problem;
  for (std::size_t s = 0; s < segments.size(); ++s)
    problem.AddResidualBlock(
        new SegmentCost(segments, s, maskOf(masks, s), parameters, start, scale, outlier, memories), nullptr, x.data(),
        initial[s].data());
  if (!solve(problem, false, x, initial)) return FitFailure::kNotSolved;

  ModelFit fit;
  fit.model = start;
  fit.stddev = standardDeviations(problem, parameters, x.data());
  fit.motion = scale;
  parameters.apply(x.data(), fit.model);
  if (!(fit.model.stiffness_to_mass > 0.0)) return FitFailure::kNoSpring;
  if (!canFollow(fit.model, records.front()->period())) return FitFailure::kTooFast;
  for (std::size_t s = 0; s < segments.size(); ++s)
    states[s] = {initial[s][0] * scale.travel, initial[s][1] * scale.travel_rate, {}};
  if (!addResiduals(segments, states, fit)) return FitFailure::kRunsAway;
  return fit;
}

std::optional<std::vector<StrutState>> estimateInitialStates(const Records& records, const StrutModel& model) {
  const FitOutcome at_rest = withoutFit(records, model);
  if (!at_rest) return std::nullopt;
  const Segments segments = segmentsOf(records);
  const double size = std::sqrt(meanSquare(at_rest->residuals)), rate = std::sqrt(model.stiffness_to_mass);
  if (size == 0.0) return at_rest->initial;
  const MotionScale scale{size / model.stiffness_to_mass, size / rate, 1.0 / rate};
  const Parameterization parameters(model, std::vector<double>(numbersOf(model).size(), 1.0), scale);
  CarriedMemories memories(segments, at_rest->initial);
  Eigen::VectorXd x = parameters.initial();
  LocalStates initial(segments.size(), {0.0, 0.0});
  ceres::Problem problem;
  for (std::size_t s = 0; s < segments.size(); ++s)
    problem.AddResidualBlock(
        new SegmentCost(segments, s, nullptr, parameters, model, scale, kOutlierScale * size, memories), nullptr,
        x.data(), initial[s].data());
  if (!solve(problem, true, x, initial)) return std::nullopt;
  std::vector<StrutState> states = at_rest->initial;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    states[s].travel = initial[s][0] * scale.travel;
    states[s].travel_rate = initial[s][1] * scale.travel_rate;
  }
  return states;
}

double meanOf(const Residuals& residuals) {
  const Eigen::VectorXd all = joined(residuals);
  return all.size() > 0 ? all.mean() : 0.0;
}

double meanSquare(const Residuals& residuals) {
  const Eigen::VectorXd all = joined(residuals);
  return all.size() > 0 ? all.squaredNorm() / static_cast<double>(all.size()) : 0.0;
}

FitOutcome withoutFit(const Records& records, const StrutModel& model) {
  ModelFit fit;
  fit.model = model;
  const Segments segments = segmentsOf(records);
  if (!addResiduals(segments, std::vector<StrutState>(segments.size()), fit)) return FitFailure::kRunsAway;
  return fit;
}

}  // namespace suspension_health_monitor
