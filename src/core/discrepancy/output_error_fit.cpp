#include "suspension_health_monitor/discrepancy/output_error_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "first_run.h"
#include "parameterization.h"
#include "segment_cost.h"
#include "suspension_health_monitor/model/free_run.h"

namespace suspension_health_monitor {
namespace {

constexpr double kRunaway = 1e3;  // times the drive's largest measured acceleration

/// @return nothing if an effect never acts in these drives, or a fault of the measurement cannot show in them.
std::optional<std::vector<double>> coefficientScales(const StrutModel& start, const DriveSizes& sizes, double period) {
  std::vector<double> scales;
  for (const double force : sizes.forces) {
    if (force == 0.0) return std::nullopt;
    scales.push_back(0.1 * sizes.acceleration / force);
  }
  const ReadingSizes reading_sizes{sizes.residual, sizes.acceleration, period, sizes.body};
  for (const ActiveMeasurementEffect& reading : start.reading)
    for (std::size_t i = 0; i < reading.coefficients.size(); ++i) {
      scales.push_back(reading.effect.scale(reading_sizes, i));
      if (!std::isfinite(scales.back())) return std::nullopt;
    }
  return scales;
}

/// Standard deviations of the model's numbers (in SI), the initial states of the segments being unknown, too.
Eigen::VectorXd standardDeviations(const ceres::Problem& problem, const Parameterization& parameters,
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
    information += shared.transpose() * shared - cross.transpose() * (local.transpose() * local).ldlt().solve(cross);
    square += residuals.squaredNorm();
    count += static_cast<double>(residuals.size());
  }
  const Eigen::MatrixXd covariance =
      square / count * information.ldlt().solve(Eigen::MatrixXd::Identity(parameters.size(), parameters.size()));
  return covariance.diagonal().cwiseMax(0.0).cwiseSqrt().cwiseProduct(parameters.slopes(model).cwiseAbs());
}

/// Fits the model `x` and the initial states in place.
/// @return the model's standard deviations; nothing if the solver fails.
std::optional<Eigen::VectorXd> solve(const FitRecords& records, const FitMasks& masks, const StrutModel& start,
                                     const Parameterization& parameters, const CostScales& scales, int max_iterations,
                                     Eigen::VectorXd& x, std::vector<std::array<double, 2>>& initial) {
  ceres::Problem problem;
  auto* ordering = new ceres::ParameterBlockOrdering;  // the solver's options own it
  ceres::Solver::Options solver;
  solver.linear_solver_ordering.reset(ordering);
  std::size_t index = 0;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (std::size_t s = 0; s < records[r]->segments().size(); ++s, ++index) {
      problem.AddResidualBlock(
          new SegmentCost(*records[r], records[r]->segments()[s], maskOf(masks, r, s), parameters, start, scales),
          nullptr, x.data(), initial[index].data());
      ordering->AddElementToGroup(initial[index].data(), 0);
    }
  ordering->AddElementToGroup(x.data(), 1);
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.max_num_iterations = max_iterations;
  solver.function_tolerance = 1e-7;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (!summary.IsSolutionUsable()) return std::nullopt;
  return standardDeviations(problem, parameters, x.data());
}

/// A first guess of coefficients by linear thinking may make the model run away: they are halved until it does not.
/// @return false if that does not help.
bool tame(const FitRecords& records, const std::vector<StrutState>& initial, StrutModel& model) {
  constexpr int most_halvings = 4;
  std::vector<double> predicted;
  for (int i = 0; i <= most_halvings; ++i) {
    bool runs = true;
    std::size_t index = 0;
    for (const DriveRecord* record : records)
      for (const DriveSegment& segment : record->segments()) {
        const StrutState start = initial.empty() ? StrutState{} : initial[index];
        runs = runs && runFree(model, *record, segment, start, predicted);
        ++index;
      }
    if (runs) return true;
    for (ActiveEffect& active : model.effects) active.coefficient /= 2.0;
  }
  return false;
}

/// Adds initial state and residuals of a segment.
bool addResiduals(const DriveRecord& record, const DriveSegment& segment, const StrutState& state, ModelFit& fit) {
  std::vector<double> residuals;
  if (!runFree(fit.model, record, segment, state, residuals)) return false;
  for (std::size_t k = 0; k < residuals.size(); ++k) residuals[k] = segment.sprung[k] - residuals[k];
  fit.initial.push_back(state);
  fit.residuals.push_back(std::move(residuals));
  return true;
}

}  // namespace

bool runFree(const StrutModel& model, const DriveRecord& record, const DriveSegment& segment, StrutState state,
             std::vector<double>& predicted, std::vector<StrutState>* motion) {
  double largest = 0.0;
  for (const double y : segment.sprung) largest = std::max(largest, std::abs(y));
  const RecordedWheel wheel{segment.wheel, segment.start, record.period(), record.steps(), segment.size()};
  if (!FreeRun::follow(model, wheel, state, kRunaway * largest, predicted, motion)) return false;
  for (const ActiveMeasurementEffect& reading : model.reading)
    reading.effect.apply(reading.coefficients.data(), segment.body, record.period(), predicted);
  return true;
}

std::optional<ModelFit> fitOutputError(const std::vector<const DriveRecord*>& records,
                                       const std::vector<std::vector<SampleMask>>& masks, const StrutModel& guess,
                                       const FitOptions& options) {
  StrutModel start = guess;
  if (!tame(records, options.initial, start)) return std::nullopt;
  const std::optional<DriveSizes> sizes = firstRun(records, masks, start);
  if (!sizes) return std::nullopt;
  const auto coefficient_scales = coefficientScales(start, *sizes, records.front()->period());
  if (!coefficient_scales) return std::nullopt;
  const MotionScale motion{sizes->travel, sizes->travel_rate, 1.0 / std::sqrt(start.stiffness_to_mass)};
  const Parameterization parameters(start, *coefficient_scales, motion);
  const CostScales scales{sizes->travel, sizes->travel_rate,
                          std::max(options.outlier_scale * sizes->residual, 1e-9 * sizes->acceleration)};
  Eigen::VectorXd x = parameters.initial();
  std::size_t num_segments = 0;
  for (const DriveRecord* record : records) num_segments += record->segments().size();
  std::vector<std::array<double, 2>> initial(num_segments, {0.0, 0.0});
  for (std::size_t i = 0; i < options.initial.size(); ++i)
    initial[i] = {options.initial[i].travel / scales.travel, options.initial[i].travel_rate / scales.travel_rate};
  const auto stddev = solve(records, masks, start, parameters, scales, options.max_iterations, x, initial);
  if (!stddev) return std::nullopt;

  ModelFit fit;
  fit.model = start;
  fit.stddev = *stddev;
  parameters.apply(x.data(), fit.model);
  std::size_t index = 0;
  for (const DriveRecord* record : records)
    for (const DriveSegment& segment : record->segments()) {
      StrutState state;
      state.travel = initial[index][0] * scales.travel;
      state.travel_rate = initial[index][1] * scales.travel_rate;
      ++index;
      if (!addResiduals(*record, segment, state, fit)) return std::nullopt;
    }
  return fit;
}

}  // namespace suspension_health_monitor
