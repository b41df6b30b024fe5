#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/record/motion_scale.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

using Segments = std::vector<const DriveSegment*>;

/// @return the mask of a segment; none if all samples are fitted.
inline const SampleMask* maskOf(const std::vector<SampleMask>& masks, std::size_t segment) {
  return masks.empty() ? nullptr : &masks[segment];
}

/// What a run from rest, the effects not acting yet, shows of the drives: rms values.
struct DriveSizes {
  double travel = 0.0, travel_rate = 0.0;
  std::vector<double> forces;                   ///< of the effects, per unit of their coefficient
  double acceleration = 0.0;                    ///< of the measured z'', what is fitted only
  double residual = 0.0;                        ///< robust, what is fitted only
  std::array<double, kNumBodyChannels> body{};  ///< 0 where a channel is not known
};

/// @return nothing if the model runs away or there is nothing to fit.
std::optional<DriveSizes> measureSizes(const Segments& segments, const std::vector<SampleMask>& masks,
                                       const StrutModel& start);

/// A model as a vector of numbers of order 1, in the order of valuesOf(): b1 and b0 relative to their start,
/// coefficients relative to a force of the size of the linear one, shapes by their place in their range (logistic in
/// the logarithm): beyond its range many a law turns into another one that the model has already, and a fit would lose
/// its way there.
class Parameterization {
 public:
  /// @param coefficient_scales  of the effects, then of the reading's [unit of the coefficient].
  /// @param motion  what the shapes' ranges are counted in; ranges are widened to hold the start.
  Parameterization(const StrutModel& start, const std::vector<double>& coefficient_scales, const MotionScale& motion);

  int size() const { return static_cast<int>(numbers_.size()); }

  /// @return the start as a vector.
  const Eigen::VectorXd& initial() const { return initial_; }

  /// @param model  its numbers are replaced; it has the effects of the start.
  void apply(const double* x, StrutModel& model) const;

  /// @return d(SI value)/dx at x.
  Eigen::VectorXd slopes(const double* x) const;

 private:
  /// value = scale x; of a shape ln value = lower + width / (1 + exp(-x)), width > 0.
  struct Number {
    double scale = 0.0, lower = 0.0, width = 0.0;

    bool isShape() const { return width > 0.0; }
    double value(double x) const;
    double slope(double x) const;
  };

  std::vector<Number> numbers_;
  Eigen::VectorXd initial_;
};

/// What a segment's initial state is counted in, and where a residual begins to count as an outlier.
struct CostScales {
  double travel = 0.0, travel_rate = 0.0;  ///< [m], [m/s]
  double outlier = 0.0;                    ///< [m/s^2]
};

class CarriedMemories;

/// Residuals of one segment. Parameter blocks: the model, the segment's initial travel and travel rate.
/// The arguments must outlive it.
class SegmentCost : public ceres::CostFunction {
 public:
  /// @param index  of the segment.  @param mask  none: all samples.
  SegmentCost(const Segments& segments, std::size_t index, const SampleMask* mask, const Parameterization& parameters,
              const StrutModel& model, const CostScales& scales, CarriedMemories& memories);

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
  std::size_t index_;
  const Parameterization& parameters_;
  const StrutModel& model_;
  CostScales scales_;
  CarriedMemories& memories_;
  std::vector<std::size_t> used_;
};

/// Gives every segment the memories that last (ForceEffect::lasts) from the run over those before it, less what the
/// time between them takes. Nothing happens where none lasts.
/// @param states  that the segments begin with; the memories are replaced.
void carryMemories(const StrutModel& model, const Segments& segments, std::vector<StrutState>& states);

/// The same for a fit, whose costs ask segment by segment for the same models again and again.
class CarriedMemories {
 public:
  /// @param states  travel and travel rate that the segments begin with, about.
  CarriedMemories(const Segments& segments, std::vector<StrutState> states);

  /// @return of one segment, by kMostEffects.
  const std::array<Memory, kMostEffects>& at(std::size_t segment, StrutModel& model);

 private:
  const Segments& segments_;
  std::vector<StrutState> states_;
  std::map<std::vector<double>, std::vector<StrutState>> known_;  // by the numbers of the model
};

}  // namespace suspension_health_monitor
