#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "parameterization.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

/// Residuals of one segment. Parameter blocks: the model, the segment's initial travel and travel rate.
/// The arguments must outlive it.
class SegmentCost : public ceres::CostFunction {
 public:
  /// @param index  of the segment.  @param mask  none: all samples.
  /// @param parameters  its motion is what the initial state is counted in.
  /// @param outlier  where a residual begins to count as one [m/s^2].
  SegmentCost(const Segments& segments, std::size_t index, const SampleMask* mask, const Parameterization& parameters,
              double outlier, CarriedMemories& memories)
      : segment_(*segments[index]), index_(index), parameters_(parameters), outlier_(outlier), memories_(memories) {
    for (std::size_t k = 0; k < segment_.size(); ++k)
      if (mask == nullptr || (*mask)[k] != 0) used_.push_back(k);
    set_num_residuals(static_cast<int>(used_.size()));
    mutable_parameter_block_sizes()->push_back(parameters.size());
    mutable_parameter_block_sizes()->push_back(2);
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    Eigen::VectorXd shared = Eigen::Map<const Eigen::VectorXd>(x[0], parameters_.size());
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
    StrutModel model = parameters_.model(shared.data());
    const MotionScale& unit = parameters_.motion();
    const StrutState state{local[0] * unit.travel, local[1] * unit.travel_rate, memories_.at(index_, model)};
    std::vector<double> predicted;
    if (!runFree(model, segment_, state, predicted)) return false;
    for (std::size_t i = 0; i < used_.size(); ++i) residuals[i] = segment_.sprung[used_[i]] - predicted[used_[i]];
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
  double spread(double r) const { return std::sqrt(1.0 + square(r / outlier_)); }

  const DriveSegment& segment_;
  std::size_t index_;
  const Parameterization& parameters_;
  double outlier_;
  CarriedMemories& memories_;
  std::vector<std::size_t> used_;
};

}  // namespace suspension_health_monitor
