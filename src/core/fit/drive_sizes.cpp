#include <cmath>

#include "parameterization.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

/// Sums squares over one segment.
void addSegment(const StrutModel& start, const DriveSegment& segment, const std::vector<StrutState>& motion,
                DriveSizes& sums) {
  for (std::size_t k = 0; k < segment.size(); ++k) {
    const StrutState& state = motion[k];
    sums.travel += square(state.travel);
    sums.travel_rate += square(state.travel_rate);
    for (std::size_t j = 0; j < start.effects.size(); ++j) {
      const auto& [effect, coefficient, shapes] = start.effects[j];
      const StrutMotion here{state.travel, state.travel_rate, segment.timeDriven(k), state.memory[j]};
      sums.forces[j] += square(effect.force(here, shapes.data()));
    }
  }
  for (std::size_t c = 0; c < kNumBodyChannels; ++c)
    for (const double value : segment.body[c]) sums.body[c] += square(value);
}

}  // namespace

std::optional<DriveSizes> measureSizes(const Segments& segments, const std::vector<SampleMask>& masks,
                                       const StrutModel& start) {
  StrutModel linear = start;  // the effects' memories run along
  for (ActiveEffect& active : linear.effects) active.coefficient = 0.0;
  DriveSizes sizes;
  sizes.forces.resize(start.effects.size(), 0.0);
  double count = 0.0;
  std::vector<double> fitted, predicted;
  std::vector<StrutState> motion;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const DriveSegment& segment = *segments[s];
    if (!runFree(linear, segment, {}, predicted, &motion)) return std::nullopt;
    addSegment(start, segment, motion, sizes);
    count += static_cast<double>(segment.size());
    const SampleMask* mask = maskOf(masks, s);
    for (std::size_t k = 0; k < segment.size(); ++k) {
      if (mask != nullptr && (*mask)[k] == 0) continue;
      sizes.acceleration += square(segment.sprung[k]);
      fitted.push_back(segment.sprung[k] - predicted[k]);
    }
  }
  if (fitted.empty()) return std::nullopt;
  for (double* sum : {&sizes.travel, &sizes.travel_rate}) *sum = std::sqrt(*sum / count);
  for (double& sum : sizes.forces) sum = std::sqrt(sum / count);
  for (double& sum : sizes.body) sum = std::sqrt(sum / count);
  sizes.acceleration = std::sqrt(sizes.acceleration / static_cast<double>(fitted.size()));
  sizes.residual = robustDeviation(std::move(fitted));
  return sizes;
}

}  // namespace suspension_health_monitor
