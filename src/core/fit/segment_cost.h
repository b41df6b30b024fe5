#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

#include "parameterization.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"

namespace suspension_health_monitor {

/// What a segment's initial state is counted in, and where a residual begins to count as an outlier.
struct CostScales {
  double travel = 0.0, travel_rate = 0.0;  ///< [m], [m/s]
  double outlier = 0.0;                    ///< [m/s^2]
};

/// Residuals of one segment. Parameter blocks: the model, the segment's initial travel and travel rate.
/// The arguments must outlive it.
class SegmentCost : public ceres::CostFunction {
 public:
  /// @param mask  none: all samples.
  SegmentCost(const DriveSegment& segment, const SampleMask* mask, const Parameterization& parameters,
              const StrutModel& model, const CostScales& scales);

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override;

 private:
  bool evaluate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local, Eigen::VectorXd& residuals) const;

  /// Derivative of the damped residuals with respect to `varied`, one of the two others. Row by row.
  bool differentiate(const Eigen::VectorXd& shared, const Eigen::VectorXd& local, Eigen::VectorXd& varied,
                     const Eigen::VectorXd& base, double* jacobian) const;

  // Smooth Huber loss as a change of the residual: half its square is a^2 (sqrt(1 + (r/a)^2) - 1).
  double damp(double r) const;
  double dampSlope(double r) const;

  const DriveSegment& segment_;
  const Parameterization& parameters_;
  const StrutModel& model_;
  CostScales scales_;
  std::vector<std::size_t> used_;
};

}  // namespace suspension_health_monitor
