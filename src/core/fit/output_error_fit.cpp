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

/// The model's numbers and the state that every segment begins with, as the solver finds them together.
class OutputErrorProblem {
 public:
  /// @param states  a first guess.  @param outlier  where a residual begins to count as one [m/s^2].
  /// The arguments must outlive this object.
  OutputErrorProblem(const Segments& segments, const std::vector<SampleMask>& masks, const Parameterization& parameters,
                     double outlier, const std::vector<StrutState>& states)
      : parameters_(parameters),
        states_(states),
        memories_(segments, states),
        model_(parameters.initial()),
        initial_(segments.size()) {
    const auto inUnits = [](double value, double unit) { return value == 0.0 ? 0.0 : value / unit; };  // which may be 0
    for (std::size_t s = 0; s < segments.size(); ++s) {
      initial_[s] = {inUnits(states[s].travel, parameters.motion().travel),
                     inUnits(states[s].travel_rate, parameters.motion().travel_rate)};
      const SampleMask* mask = maskOf(masks, s);
      // Ceres takes no residual block of nothing.
      if (mask != nullptr && std::none_of(mask->begin(), mask->end(), [](auto used) { return used != 0; })) continue;
      problem_.AddResidualBlock(new SegmentCost(segments, s, mask, parameters, outlier, memories_), nullptr,
                                model_.data(), initial_[s].data());
    }
  }

  /// @param holds_model  it stays as it is.
  /// @return false if the solver fails.
  bool solve(bool holds_model) {
    auto* ordering = new ceres::ParameterBlockOrdering;  // the solver's options own it
    ceres::Solver::Options solver;
    solver.linear_solver_ordering.reset(ordering);
    for (auto& of_segment : initial_)
      if (problem_.HasParameterBlock(of_segment.data())) ordering->AddElementToGroup(of_segment.data(), 0);
    ordering->AddElementToGroup(model_.data(), 1);
    if (holds_model) problem_.SetParameterBlockConstant(model_.data());
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.max_num_iterations = 25;
    solver.function_tolerance = 1e-7;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  StrutModel model() const { return parameters_.model(model_.data()); }

  std::vector<StrutState> initial() const {
    std::vector<StrutState> states = states_;
    for (std::size_t s = 0; s < states.size(); ++s) {
      states[s].travel = initial_[s][0] * parameters_.motion().travel;
      states[s].travel_rate = initial_[s][1] * parameters_.motion().travel_rate;
    }
    return states;
  }

  /// Of the model's numbers (in SI), the initial states being unknown, too.
  std::vector<double> standardDeviations() const {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(parameters_.size(), parameters_.size());
    double squares = 0.0, count = 0.0;
    std::vector<ceres::ResidualBlockId> blocks;
    problem_.GetResidualBlocks(&blocks);
    for (const ceres::ResidualBlockId block : blocks) {
      std::vector<double*> x;
      problem_.GetParameterBlocksForResidualBlock(block, &x);
      const ceres::CostFunction* cost = problem_.GetCostFunctionForResidualBlock(block);
      Eigen::VectorXd residuals(cost->num_residuals());
      RowMajor shared(cost->num_residuals(), parameters_.size()), local(cost->num_residuals(), 2);
      double* jacobians[2] = {shared.data(), local.data()};
      if (!cost->Evaluate(x.data(), residuals.data(), jacobians)) continue;
      const Eigen::MatrixXd cross = local.transpose() * shared;
      information += shared.transpose() * shared - cross.transpose() * solveSymmetric(local.transpose() * local, cross);
      squares += residuals.squaredNorm();
      count += static_cast<double>(residuals.size());
    }
    const Eigen::MatrixXd covariance =
        squares / count *
        solveSymmetric(information, Eigen::MatrixXd::Identity(information.rows(), information.cols()));
    const Eigen::VectorXd deviations =
        covariance.diagonal().cwiseMax(0.0).cwiseSqrt().cwiseProduct(parameters_.slopes(model_.data()).cwiseAbs());
    return {deviations.data(), deviations.data() + deviations.size()};
  }

 private:
  const Parameterization& parameters_;
  const std::vector<StrutState>& states_;
  CarriedMemories memories_;
  Eigen::VectorXd model_;                       // the numbers of the parameterization
  std::vector<std::array<double, 2>> initial_;  // travel and travel rate, in units of the motion
  ceres::Problem problem_;
};

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
  const std::size_t lead = segment.lead(), count = segment.size() + 2 * lead;
  const double start = segment.timeDriven(0) - static_cast<double>(lead) * segment.period;
  const double step = segment.period / segment.steps;
  predicted.resize(count);
  if (motion != nullptr) motion->resize(count);
  auto wheel = segment.wheel.begin();
  for (std::size_t k = 0; k < count; ++k) {
    const double time = start + static_cast<double>(k) * segment.period;
    predicted[k] = model.force(state.travel, state.travel_rate, time, state.memory.data());
    if (!(std::abs(predicted[k]) <= kRunaway * largest)) return false;  // NaN, too
    if (motion != nullptr) (*motion)[k] = state;
    if (k + 1 == count) break;
    for (int s = 0; s < segment.steps; ++s) integrateStrut(model, time + s * step, step, *wheel++, state);
  }
  passLow(segment.taps, predicted);
  cutEnds(lead, predicted);
  if (motion != nullptr) cutEnds(lead, *motion);
  model.read(segment.body, segment.period, predicted);
  return true;
}

std::optional<Residuals> freeRunResiduals(const StrutModel& model, const Segments& segments,
                                          const std::vector<StrutState>& initial, FreeMotion* motion) {
  Residuals all;
  if (motion != nullptr) motion->resize(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::vector<double>& residuals = all.emplace_back();
    std::vector<StrutState>* const of_segment = motion != nullptr ? &(*motion)[s] : nullptr;
    if (!runFree(model, *segments[s], initial[s], residuals, of_segment)) return std::nullopt;
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
  const Parameterization parameters(start, *coefficient_scales, sizes->motion);
  const double outlier = std::max(kOutlierScale * sizes->reading.residual, 1e-9 * sizes->reading.y);
  for (StrutState& state : states) state.memory = {};
  OutputErrorProblem problem(segments, masks, parameters, outlier, states);
  if (!problem.solve(false)) return FitFailure::kNotSolved;

  ModelFit fit{problem.model(), {}, {}, problem.standardDeviations(), sizes->motion};
  if (!(fit.model.stiffness_to_mass > 0.0)) return FitFailure::kNoSpring;
  if (!canFollow(fit.model, records.front()->period())) return FitFailure::kTooFast;
  if (!addResiduals(segments, problem.initial(), fit)) return FitFailure::kRunsAway;
  return fit;
}

std::optional<std::vector<StrutState>> estimateInitialStates(const Records& records, const StrutModel& model) {
  const FitOutcome at_rest = withoutFit(records, model);
  if (!at_rest) return std::nullopt;
  const double size = std::sqrt(meanSquare(at_rest->residuals)), rate = std::sqrt(model.stiffness_to_mass);
  if (size == 0.0) return at_rest->initial;
  const Parameterization parameters(model, std::vector<double>(numbersOf(model).size(), 1.0),
                                    {size / model.stiffness_to_mass, size / rate, 1.0 / rate});
  const Segments segments = segmentsOf(records);
  OutputErrorProblem problem(segments, {}, parameters, kOutlierScale * size, at_rest->initial);
  if (!problem.solve(true)) return std::nullopt;
  return problem.initial();
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
