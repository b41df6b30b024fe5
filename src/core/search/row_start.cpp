#include "row_start.h"

#include <cmath>

#include "shape_scan.h"
#include "suspension_health_monitor/internal/fit/motion_error.h"
#include "suspension_health_monitor/internal/fit/rough_model.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

RowStart::RowStart(const Records& records, const HoldOut& held_out, const ModelFit& fit) : fit_(fit) {
  const double b0 = fit.model.stiffness_to_mass;
  std::vector<double> measured, weight;
  double travel = 0.0, rate = 0.0;
  for (const DriveSegment* segment : segmentsOf(records)) {
    std::vector<double> relative = segment->unsprung;
    for (std::size_t k = 0; k < relative.size(); ++k) relative[k] -= segment->sprung[k];
    const MotionError motion = motionError(relative, mean(relative), segment->period, b0);
    for (std::size_t k = 0; k < relative.size(); ++k) {
      motion_.push_back({motion.travel[k], motion.travel_rate[k], segment->timeDriven(k), 0.0, segment->sprung[k]});
      measured.push_back(segment->sprung[k]);
      weight.push_back(held_out.training[ends_.size()][k]);
      travel += square(motion.travel[k]);
      rate += square(motion.travel_rate[k]);
    }
    ends_.push_back(motion_.size());
  }
  const auto count = static_cast<Eigen::Index>(motion_.size());
  scale_ = {std::sqrt(travel / static_cast<double>(count)), std::sqrt(rate / static_cast<double>(count)),
            1.0 / std::sqrt(b0)};
  const std::vector<ActiveEffect>& effects = fit.model.effects;
  Eigen::MatrixXd common(count, 2 + static_cast<Eigen::Index>(effects.size()));
  for (Eigen::Index k = 0; k < count; ++k) {
    common(k, 0) = motion_[static_cast<std::size_t>(k)].travel_rate;
    common(k, 1) = motion_[static_cast<std::size_t>(k)].travel;
  }
  for (std::size_t j = 0; j < effects.size(); ++j)
    common.col(2 + static_cast<Eigen::Index>(j)) = forceAlong(effects[j].effect, effects[j].shapes, motion_, ends_);
  rows_ = WeightedProjection(common, Eigen::Map<const Eigen::VectorXd>(weight.data(), count),
                             Eigen::Map<const Eigen::VectorXd>(measured.data(), count));
}

std::optional<RowStart::Start> RowStart::with(const ForceEffect& effect) const {
  std::optional<Start> best;
  const double left = rows_.left();
  for (const std::vector<double>& shapes : scanShapes(effect, scale_)) {
    const auto part = rows_.project(forceAlong(effect, shapes, motion_, ends_));
    if (!part) continue;
    const double coefficient = part->coefficients[0], share = part->gain / left;
    if (!(share > (best ? best->share : 0.0)) || (effect.positive && !(coefficient > 0.0))) continue;
    StrutModel model = fit_.model;
    model.damping_to_mass = part->common[0];
    model.stiffness_to_mass = part->common[1];
    if (!isDampedSpring(model)) continue;
    for (std::size_t j = 0; j < model.effects.size(); ++j)
      model.effects[j].coefficient = part->common[2 + static_cast<Eigen::Index>(j)];
    model.effects.push_back({effect, coefficient, shapes});
    best = Start{model, share};
  }
  return best;
}

}  // namespace suspension_health_monitor
