#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "parameterization.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

inline bool hasLasting(const StrutModel& model) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [](const ActiveEffect& active) { return active.effect.lasts; });
}

/// Gives every segment the memories that last (ForceEffect::lasts) from the run over those before it, less what the
/// time between them takes. Nothing happens where none lasts.
/// @param states  that the segments begin with; the memories are replaced.
inline void carryMemories(const StrutModel& model, const Segments& segments, std::vector<StrutState>& states) {
  if (!hasLasting(model)) return;
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  for (std::size_t s = 0; s + 1 < segments.size(); ++s) {
    if (!runFree(model, *segments[s], states[s], predicted, &motion)) return;
    states[s + 1].memory = motion.back().memory;
    keepLasting(model, restBetween(*segments[s], *segments[s + 1]), states[s + 1].memory);
  }
}

/// The model's numbers and the state that every segment begins with, as the solver finds them together.
class OutputErrorProblem {
 public:
  /// @param masks  none: all samples.  @param outlier  where a residual begins to count as one [m/s^2].
  /// @param states  a first guess, with the memories that the segments begin with.
  /// All arguments but the masks must outlive this object.
  OutputErrorProblem(const Segments& segments, const std::vector<SampleMask>& masks, const Parameterization& parameters,
                     double outlier, const std::vector<StrutState>& states)
      : segments_(segments),
        parameters_(parameters),
        outlier_(outlier),
        states_(states),
        model_(parameters.initial()),
        initial_(segments.size()) {
    const auto inUnits = [](double value, double unit) { return value == 0.0 ? 0.0 : value / unit; };  // which may be 0
    for (std::size_t s = 0; s < segments.size(); ++s) {
      initial_[s] = {inUnits(states[s].travel, parameters.motion().travel),
                     inUnits(states[s].travel_rate, parameters.motion().travel_rate)};
      auto cost = std::make_unique<Cost>(*this, s, masks);
      if (cost->num_residuals() > 0)  // Ceres takes no residual block of nothing
        problem_.AddResidualBlock(cost.release(), nullptr, model_.data(), initial_[s].data());
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
  /// Residuals of one segment. Parameter blocks: the model, the segment's initial travel and travel rate.
  class Cost : public ceres::CostFunction {
   public:
    Cost(OutputErrorProblem& problem, std::size_t index, const std::vector<SampleMask>& masks)
        : problem_(problem), index_(index) {
      for (std::size_t k = 0; k < problem.segments_[index]->size(); ++k)
        if (masks.empty() || masks[index][k] != 0) used_.push_back(k);
      set_num_residuals(static_cast<int>(used_.size()));
      mutable_parameter_block_sizes()->push_back(problem.parameters_.size());
      mutable_parameter_block_sizes()->push_back(2);
    }

    bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
      Eigen::VectorXd shared = Eigen::Map<const Eigen::VectorXd>(x[0], problem_.parameters_.size());
      Eigen::VectorXd local = Eigen::Map<const Eigen::VectorXd>(x[1], 2);
      Eigen::VectorXd base(num_residuals());
      if (!evaluate(shared, local, base)) return false;
      Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = base.unaryExpr([this](double r) { return damp(r); });
      if (jacobians == nullptr) return true;
      if (jacobians[0] != nullptr) differentiate(shared, local, shared, base, jacobians[0]);
      if (jacobians[1] != nullptr) differentiate(shared, local, local, base, jacobians[1]);
      return true;
    }

   private:
    bool evaluate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local, Eigen::VectorXd& residuals) const {
      StrutModel model = problem_.parameters_.model(shared.data());
      const MotionScale& unit = problem_.parameters_.motion();
      const StrutState state{local[0] * unit.travel, local[1] * unit.travel_rate, problem_.memoriesAt(index_, model)};
      std::vector<double> predicted;
      if (!runFree(model, *problem_.segments_[index_], state, predicted)) return false;
      const std::vector<double>& sprung = problem_.segments_[index_]->sprung;
      for (std::size_t i = 0; i < used_.size(); ++i) residuals[i] = sprung[used_[i]] - predicted[used_[i]];
      return true;
    }

    /// Derivative of the damped residuals with respect to `varied`, one of the two others. Row by row.
    void differentiate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local, Eigen::VectorXd& varied,
                       const Eigen::VectorXd& base, double* jacobian) const {
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      Eigen::Map<RowMajor> columns(jacobian, num_residuals(), varied.size());
      Eigen::VectorXd moved(num_residuals());
      for (Eigen::Index i = 0; i < varied.size(); ++i) {
        const double kept = varied[i];
        double step = kDifferenceStep * std::max(1.0, std::abs(kept));
        varied[i] = kept + step;
        if (!evaluate(shared, local, moved)) {  // at the edge of stability: look the other way
          step = -step;
          varied[i] = kept + step;
          if (!evaluate(shared, local, moved)) moved = base;  // on a ridge: it stays where it is
        }
        varied[i] = kept;
        for (int k = 0; k < num_residuals(); ++k) columns(k, i) = (moved[k] - base[k]) / step * dampSlope(base[k]);
      }
    }

    // Smooth Huber loss as a change of the residual: half its square is a^2 (sqrt(1 + (r/a)^2) - 1).
    double damp(double r) const { return r * std::sqrt(2.0 / (1.0 + spread(r))); }
    double dampSlope(double r) const { return std::sqrt((1.0 + spread(r)) / 2.0) / spread(r); }
    double spread(double r) const { return std::sqrt(1.0 + square(r / problem_.outlier_)); }

    OutputErrorProblem& problem_;
    std::size_t index_;
    std::vector<std::size_t> used_;  // samples
  };

  /// @return the memories that a segment begins with. Costs ask segment by segment for the same models again and again.
  const std::array<Memory, kMostEffects>& memoriesAt(std::size_t segment, StrutModel& model) {
    if (segment == 0 || !hasLasting(model)) return states_[segment].memory;
    std::vector<double> numbers;
    for (const double* number : valuesOf(model)) numbers.push_back(*number);
    if (known_.size() > 2 * numbers.size()) known_.clear();  // a point and its derivatives, and the point before
    const auto [known, is_new] = known_.try_emplace(std::move(numbers), states_);
    if (is_new) carryMemories(model, segments_, known->second);
    return known->second[segment].memory;
  }

  const Segments& segments_;
  const Parameterization& parameters_;
  double outlier_;
  const std::vector<StrutState>& states_;
  std::map<std::vector<double>, std::vector<StrutState>> known_;  // states with their memories, by the model's numbers
  Eigen::VectorXd model_;                                         // the numbers of the parameterization
  std::vector<std::array<double, 2>> initial_;                    // travel and travel rate, in units of the motion
  ceres::Problem problem_;
};

}  // namespace suspension_health_monitor
