#include "suspension_health_monitor/internal/record/untestable_effects.h"

#include <algorithm>

namespace suspension_health_monitor {
namespace {

bool isKnown(const Records& records, BodyChannel channel) {
  const std::vector<const DriveSegment*> segments = segmentsOf(records);
  return std::none_of(segments.begin(), segments.end(), [&](const DriveSegment* segment) {
    return segment->body[static_cast<std::size_t>(channel)].empty();
  });
}

}  // namespace

std::vector<UntestableEffect> takeUntestable(EffectLibrary& library, const Records& records) {
  std::vector<UntestableEffect> untestable;
  std::vector<MeasurementEffect> testable;
  for (const MeasurementEffect& effect : library.readings) {
    const auto unknown = std::find_if(effect.channels.begin(), effect.channels.end(),
                                      [&](BodyChannel channel) { return !isKnown(records, channel); });
    if (unknown == effect.channels.end())
      testable.push_back(effect);
    else
      untestable.push_back({effect.name, *unknown});
  }
  library.readings = testable;
  return untestable;
}

}  // namespace suspension_health_monitor
