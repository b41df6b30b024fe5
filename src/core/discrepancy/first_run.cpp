#include "first_run.h"

#include <cmath>

#include "median.h"

namespace suspension_health_monitor {
namespace {

/// Sums squares over one segment.
void addSegment(const StrutModel& start, const DriveRecord& record, const DriveSegment& segment,
                const std::vector<StrutState>& motion, DriveSizes& sums) {
  for (std::size_t k = 0; k < segment.size(); ++k) {
    const StrutState& state = motion[k];
    sums.travel += state.travel * state.travel;
    sums.travel_rate += state.travel_rate * state.travel_rate;
    const double time = segment.start + static_cast<double>(k) * record.period();
    for (std::size_t j = 0; j < start.effects.size(); ++j) {
      const ActiveEffect& active = start.effects[j];
      const double f =
          active.effect.force({state.travel, state.travel_rate, time, state.memory[j]}, active.shapes.data());
      sums.forces[j] += f * f;
    }
  }
}

}  // namespace

std::optional<DriveSizes> firstRun(const FitRecords& records, const FitMasks& masks, const StrutModel& start) {
  StrutModel linear = start;  // the effects' memories run along
  for (ActiveEffect& active : linear.effects) active.coefficient = 0.0;
  DriveSizes sizes;
  sizes.forces.resize(start.effects.size(), 0.0);
  double count = 0.0;
  std::vector<double> absolute, predicted;
  std::vector<StrutState> motion;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (std::size_t s = 0; s < records[r]->segments().size(); ++s) {
      const DriveSegment& segment = records[r]->segments()[s];
      if (!runFree(linear, *records[r], segment, {}, predicted, &motion)) return std::nullopt;
      addSegment(start, *records[r], segment, motion, sizes);
      count += static_cast<double>(segment.size());
      const SampleMask* mask = maskOf(masks, r, s);
      for (std::size_t k = 0; k < segment.size(); ++k) {
        if (mask != nullptr && (*mask)[k] == 0) continue;
        sizes.acceleration += segment.sprung[k] * segment.sprung[k];
        absolute.push_back(std::abs(segment.sprung[k] - predicted[k]));
      }
    }
  if (absolute.empty()) return std::nullopt;
  for (double* square : {&sizes.travel, &sizes.travel_rate}) *square = std::sqrt(*square / count);
  for (double& square : sizes.forces) square = std::sqrt(square / count);
  sizes.acceleration = std::sqrt(sizes.acceleration / static_cast<double>(absolute.size()));
  sizes.residual = kSigmaPerMedian * median(absolute);
  return sizes;
}

}  // namespace suspension_health_monitor
