#include "suspension_health_monitor/discrepancy/output_error_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kRunaway = 1e3;    // times the drive's largest measured acceleration
constexpr double kDifference = 1e-6;  // relative step of the numerical derivatives

/// A model as a vector of numbers of order 1: b1 and b0 relative to their start, coefficients relative to a force of the
/// size of the linear one, shapes by the logarithm of their ratio to the start.
class Parameterization {
 public:
  Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales)
      : start_(start), coefficient_scales_(coefficient_scales) {}

  int size() const {
    int count = 2;
    for (const ActiveEffect& active : start_.effects) count += 1 + static_cast<int>(active.shapes.size());
    return count + static_cast<int>(start_.reading.size());
  }

  Eigen::VectorXd initial() const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(size());
    x[0] = x[1] = 1.0;
    int i = 2;
    for (std::size_t j = 0; j < start_.effects.size(); ++j) {
      x[i] = start_.effects[j].coefficient / coefficient_scales_[j];
      i += 1 + static_cast<int>(start_.effects[j].shapes.size());
    }
    for (std::size_t j = 0; j < start_.reading.size(); ++j) x[i++] = start_.reading[j].coefficient / readingScale(j);
    return x;
  }

  void apply(const double* x, StrutModel& model) const {
    model.damping_to_mass = x[0] * start_.damping_to_mass;
    model.stiffness_to_mass = x[1] * start_.stiffness_to_mass;
    int i = 2;
    for (std::size_t j = 0; j < start_.effects.size(); ++j) {
      model.effects[j].coefficient = x[i++] * coefficient_scales_[j];
      for (std::size_t s = 0; s < start_.effects[j].shapes.size(); ++s)
        model.effects[j].shapes[s] = start_.effects[j].shapes[s] * std::exp(x[i++]);
    }
    for (std::size_t j = 0; j < start_.reading.size(); ++j) model.reading[j].coefficient = x[i++] * readingScale(j);
  }

  /// d(SI value)/dx at x, for the standard deviations.
  Eigen::VectorXd slopes(const double* x) const {
    StrutModel model = start_;
    apply(x, model);
    Eigen::VectorXd slope(size());
    slope[0] = start_.damping_to_mass;
    slope[1] = start_.stiffness_to_mass;
    int i = 2;
    for (std::size_t j = 0; j < model.effects.size(); ++j) {
      slope[i++] = coefficient_scales_[j];
      for (const double shape : model.effects[j].shapes) slope[i++] = shape;
    }
    for (std::size_t j = 0; j < start_.reading.size(); ++j) slope[i++] = readingScale(j);
    return slope;
  }

 private:
  double readingScale(std::size_t j) const { return coefficient_scales_[start_.effects.size() + j]; }

  StrutModel start_;
  std::vector<double> coefficient_scales_;
};

struct Scales {
  double travel, travel_rate;
};

/// Residuals of one segment. Parameter blocks: the model, the segment's initial travel and travel rate.
class SegmentCost : public ceres::CostFunction {
 public:
  SegmentCost(const DriveRecord& record, const DriveSegment& segment, const SampleMask* mask,
              const Parameterization& parameters, const StrutModel& model, const Scales& scales, double outlier)
      : record_(record), segment_(segment), parameters_(parameters), model_(model), scales_(scales), outlier_(outlier) {
    for (std::size_t k = 0; k < segment.size(); ++k)
      if (mask == nullptr || (*mask)[k] != 0) used_.push_back(k);
    set_num_residuals(static_cast<int>(used_.size()));
    mutable_parameter_block_sizes()->push_back(parameters.size());
    mutable_parameter_block_sizes()->push_back(2);
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    Eigen::VectorXd shared = Eigen::Map<const Eigen::VectorXd>(x[0], parameters_.size());
    Eigen::VectorXd local = Eigen::Map<const Eigen::VectorXd>(x[1], 2);
    Eigen::VectorXd base(num_residuals()), moved(num_residuals());
    if (!evaluate(shared, local, base)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = base.unaryExpr([this](double r) { return damp(r); });
    if (jacobians == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::VectorXd* blocks[2] = {&shared, &local};
    for (int block = 0; block < 2; ++block) {
      if (jacobians[block] == nullptr) continue;
      Eigen::VectorXd& vector = *blocks[block];
      Eigen::Map<RowMajor> jacobian(jacobians[block], num_residuals(), vector.size());
      for (Eigen::Index i = 0; i < vector.size(); ++i) {
        const double kept = vector[i];
        const double step = kDifference * std::max(1.0, std::abs(kept));
        vector[i] = kept + step;
        if (!evaluate(shared, local, moved)) return false;
        vector[i] = kept;
        for (int k = 0; k < num_residuals(); ++k)
          jacobian(k, i) = (moved[k] - base[k]) / step * dampSlope(base[k]);
      }
    }
    return true;
  }

 private:
  bool evaluate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local, Eigen::VectorXd& residuals) const {
    StrutModel model = model_;
    parameters_.apply(shared.data(), model);
    StrutState state;
    state.travel = local[0] * scales_.travel;
    state.travel_rate = local[1] * scales_.travel_rate;
    std::vector<double> predicted;
    if (!runFree(model, record_, segment_, state, predicted)) return false;
    for (std::size_t i = 0; i < used_.size(); ++i)
      residuals[static_cast<Eigen::Index>(i)] = segment_.sprung[used_[i]] - predicted[used_[i]];
    return true;
  }

  // Smooth Huber loss as a change of the residual: half its square is a^2 (sqrt(1 + (r/a)^2) - 1).
  double damp(double r) const {
    const double q = r / outlier_;
    return std::copysign(outlier_ * std::sqrt(2.0 * q * q / (std::sqrt(1.0 + q * q) + 1.0)), r);
  }
  double dampSlope(double r) const {
    const double q = r / outlier_;
    const double damped = damp(r);
    return damped == 0.0 ? 1.0 : r / (std::sqrt(1.0 + q * q) * damped);
  }

  const DriveRecord& record_;
  const DriveSegment& segment_;
  const Parameterization& parameters_;
  const StrutModel& model_;
  Scales scales_;
  double outlier_;
  std::vector<std::size_t> used_;
};

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
    information += shared.transpose() * shared -
                   cross.transpose() * (local.transpose() * local).ldlt().solve(cross);
    square += residuals.squaredNorm();
    count += static_cast<double>(residuals.size());
  }
  const Eigen::MatrixXd covariance =
      square / count * information.ldlt().solve(Eigen::MatrixXd::Identity(parameters.size(), parameters.size()));
  return covariance.diagonal().cwiseMax(0.0).cwiseSqrt().cwiseProduct(parameters.slopes(model).cwiseAbs());
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

bool runFree(const StrutModel& model, const DriveRecord& record, const DriveSegment& segment, StrutState state,
             std::vector<double>& predicted, std::vector<StrutState>* motion) {
  predicted.resize(segment.size());
  if (motion != nullptr) motion->resize(segment.size());
  const double h = record.period() / record.steps();
  double largest = 0.0;
  for (const double y : segment.sprung) largest = std::max(largest, std::abs(y));
  for (std::size_t k = 0; k < segment.size(); ++k) {
    const double time = segment.start + static_cast<double>(k) * record.period();
    predicted[k] = model.force(state.travel, state.travel_rate, time, state.memory.data());
    if (!(std::abs(predicted[k]) <= kRunaway * largest)) return false;  // NaN, too
    if (motion != nullptr) (*motion)[k] = state;
    if (k + 1 == segment.size()) break;
    for (int s = 0; s < record.steps(); ++s) {
      const std::size_t step = k * static_cast<std::size_t>(record.steps()) + static_cast<std::size_t>(s);
      integrateStrut(model, time + s * h, h, segment.wheel[step], state);
    }
  }
  for (const ActiveMeasurementEffect& reading : model.reading)
    reading.effect.apply(reading.coefficient, record.period(), predicted);
  return true;
}

std::optional<ModelFit> fitOutputError(const std::vector<const DriveRecord*>& records,
                                       const std::vector<std::vector<SampleMask>>& masks, const StrutModel& start,
                                       const FitOptions& options) {
  // First run, from rest: sizes of forces and residuals.
  double travel2 = 0.0, rate2 = 0.0, y2 = 0.0;
  std::size_t count = 0;
  std::vector<double> absolute, force2(start.effects.size(), 0.0), predicted;
  std::vector<StrutState> motion;
  StrutModel linear = start;  // the effects' memories run along, their forces do not act yet
  for (ActiveEffect& active : linear.effects) active.coefficient = 0.0;
  for (const DriveRecord* record : records)
    for (const DriveSegment& segment : record->segments()) {
      if (!runFree(linear, *record, segment, {}, predicted, &motion)) return std::nullopt;
      for (std::size_t k = 0; k < segment.size(); ++k) {
        travel2 += motion[k].travel * motion[k].travel;
        rate2 += motion[k].travel_rate * motion[k].travel_rate;
        y2 += segment.sprung[k] * segment.sprung[k];
        absolute.push_back(std::abs(segment.sprung[k] - predicted[k]));
        const double time = segment.start + static_cast<double>(k) * record->period();
        for (std::size_t j = 0; j < start.effects.size(); ++j) {
          const double f = start.effects[j].effect.force({motion[k].travel, motion[k].travel_rate, time, motion[k].memory[j]},
                                                         start.effects[j].shapes.data());
          force2[j] += f * f;
        }
      }
      count += segment.size();
    }
  if (count == 0) return std::nullopt;
  const double n = static_cast<double>(count);
  const double outlier = std::max(options.outlier_scale * 1.4826 * median(absolute), 1e-9 * std::sqrt(y2 / n));
  const Scales scales{std::sqrt(travel2 / n), std::sqrt(rate2 / n)};
  std::vector<double> coefficient_scales;
  for (std::size_t j = 0; j < start.effects.size(); ++j) {
    const double size = std::sqrt(force2[j] / n);
    if (size == 0.0) return std::nullopt;  // the effect never acts in these drives
    coefficient_scales.push_back(0.1 * std::sqrt(y2 / n) / size);
  }

  const double residual = 1.4826 * median(absolute);
  for (const ActiveMeasurementEffect& reading : start.reading)
    coefficient_scales.push_back(reading.effect.scale(residual, std::sqrt(y2 / n), records.front()->period()));

  const Parameterization parameters(start, coefficient_scales);
  Eigen::VectorXd x = parameters.initial();
  std::vector<std::array<double, 2>> initial;
  for (const DriveRecord* record : records) initial.resize(initial.size() + record->segments().size(), {0.0, 0.0});
  ceres::Problem problem;
  auto* ordering = new ceres::ParameterBlockOrdering;
  std::size_t index = 0;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (std::size_t s = 0; s < records[r]->segments().size(); ++s, ++index) {
      problem.AddResidualBlock(new SegmentCost(*records[r], records[r]->segments()[s],
                                               masks.empty() ? nullptr : &masks[r][s], parameters, start, scales,
                                               outlier),
                               nullptr, x.data(), initial[index].data());
      ordering->AddElementToGroup(initial[index].data(), 0);
    }
  ordering->AddElementToGroup(x.data(), 1);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.linear_solver_ordering.reset(ordering);
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-7;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (!summary.IsSolutionUsable()) return std::nullopt;

  ModelFit fit;
  fit.model = start;
  parameters.apply(x.data(), fit.model);
  fit.stddev = standardDeviations(problem, parameters, x.data());
  index = 0;
  for (const DriveRecord* record : records)
    for (const DriveSegment& segment : record->segments()) {
      StrutState state;
      state.travel = initial[index][0] * scales.travel;
      state.travel_rate = initial[index][1] * scales.travel_rate;
      ++index;
      if (!runFree(fit.model, *record, segment, state, predicted)) return std::nullopt;
      for (std::size_t k = 0; k < predicted.size(); ++k) predicted[k] = segment.sprung[k] - predicted[k];
      fit.initial.push_back(state);
      fit.residuals.push_back(predicted);
    }
  return fit;
}

}  // namespace suspension_health_monitor
