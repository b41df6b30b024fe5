#pragma once

#include <array>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"

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

}  // namespace suspension_health_monitor
