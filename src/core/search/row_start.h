#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/fit/free_form.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/search/screening.h"

namespace suspension_health_monitor {

inline constexpr std::size_t kMostStartRows = 4000;  // a start need not be better than the noise in them allows
inline constexpr double kStretchPeriods = 32.0;      // natural periods: long against the memory of any law

/// The parts of a segment that are looked at: all of it, or stretches that are spread evenly over it.
/// @param share  of the samples, 0 .. 1.
inline std::vector<std::pair<std::size_t, std::size_t>> stretchesOf(std::size_t size, std::size_t length,
                                                                    double share) {
  if (share >= 1.0) return {{0, size}};
  std::vector<std::pair<std::size_t, std::size_t>> stretches;
  const auto step = static_cast<std::size_t>(static_cast<double>(length) / share);
  for (std::size_t first = 0; first < size; first += step)
    stretches.emplace_back(first, std::min(size, first + length));
  return stretches;
}

/// Where a fit of a law may begin that the linear response cannot tell: one with a kink or a memory that carries so
/// much of the strut's force that b1 and b0 without it are far from those beside it.
///
/// The travel follows from the measurements alone, d'' = w'' - z'', integrated twice and once by an integral that
/// forgets what is slower than a third of the natural frequency (motionError()). Along it the law is one more column of
///   z'' = b1 v + b0 d + sum_j c_j f_j + c f,
/// each behind the filter of the drive if it has one, by least squares over the training samples, shape by shape of the
/// scan. Of long drives stretches are looked at, evenly spread. Too coarse for an estimate: the noise of the sensors is
/// in d and v; it does for a start.
class RowStart {
 public:
  /// @param fit  the present model: its effects stay, with their shapes.
  RowStart(const Records& records, const HoldOut& held_out, const ModelFit& fit) : fit_(fit) {
    const double b0 = fit.model.stiffness_to_mass;
    const Segments segments = segmentsOf(records);
    double samples = 0.0;
    for (const DriveSegment* segment : segments) samples += static_cast<double>(segment->size());
    std::vector<double> measured, weight;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const DriveSegment& segment = *segments[s];
      std::vector<double> relative = segment.driving;
      for (std::size_t k = 0; k < relative.size(); ++k) relative[k] -= segment.sprung[k];
      const auto [travel, travel_rate] = motionError(relative, meanOf({relative}), segment.period, b0);
      const auto length =
          static_cast<std::size_t>(std::ceil(kStretchPeriods * 2.0 * M_PI / (std::sqrt(b0) * segment.period)));
      for (const auto& [first, end] : stretchesOf(segment.size(), length, kMostStartRows / samples)) {
        for (std::size_t k = first; k < end; ++k) {
          motion_.samples.push_back({travel[k], travel_rate[k], segment.timeDriven(k), 0.0, segment.sprung[k]});
          measured.push_back(segment.sprung[k]);
          const bool is_whole = k >= first + segment.lead() && k + segment.lead() < end;  // what the filter reaches
          weight.push_back(is_whole ? held_out.training[s][k] : 0.0);
        }
        motion_.begins.push_back(motion_.samples.size());
        taps_.push_back(segment.taps);
      }
    }
    const Eigen::Index count = motion_.samples.size();
    scale_ = scaleOf(motion_, b0);
    Eigen::MatrixXd common = forcesAlong(fit.model, motion_);
    for (Eigen::Index j = 0; j < common.cols(); ++j) passLow(common.col(j));
    rows_ = WeightedProjection(common, Eigen::Map<const Eigen::VectorXd>(weight.data(), count),
                               Eigen::Map<const Eigen::VectorXd>(measured.data(), count));
  }

  struct Start {
    StrutModel model;    ///< the present one with the effect added
    double share = 0.0;  ///< of what the rows without the effect leave that it takes
  };

  /// @return nothing if no shape leaves a damped spring and a coefficient of the right sign.
  std::optional<Start> with(const ForceEffect& effect) const {
    std::optional<Start> best;
    if (effect.lasts) return best;  // such a memory needs whole drives, not stretches
    const double unexplained = rows_.unexplained();
    for (const std::vector<double>& shapes : scanShapes(effect, scale_)) {
      Eigen::VectorXd column = forceAlong(effect, shapes, motion_);
      passLow(column);
      const auto part = rows_.project(column);
      if (!part) continue;
      const double coefficient = part->coefficients[0], share = part->gain / unexplained;
      if (!(share > (best ? best->share : 0.0)) || (effect.positive && !(coefficient > 0.0))) continue;
      StrutModel model = fit_.model;
      model.damping_to_mass = part->common[0];
      model.stiffness_to_mass = part->common[1];
      if (!model.isDampedSpring()) continue;
      for (std::size_t j = 0; j < model.effects.size(); ++j) model.effects[j].coefficient = part->common[2 + j];
      model.effects.push_back({effect, coefficient, shapes});
      best = Start{model, share};
    }
    return best;
  }

 private:
  void passLow(Eigen::Ref<Eigen::VectorXd> column) const {
    for (std::size_t i = 0; i < taps_.size(); ++i) {
      auto stretch = column.segment(motion_.begins[i], motion_.begins[i + 1] - motion_.begins[i]);
      stretch = lowPassed(taps_[i], stretch);
    }
  }

  const ModelFit& fit_;
  SegmentedMotion motion_;                 // over all stretches
  std::vector<std::vector<double>> taps_;  // of the filter of each stretch
  MotionScale scale_;
  WeightedProjection rows_;  // of z'' by v, d and the forces of the present effects; weight 0 where held out
};

}  // namespace suspension_health_monitor
