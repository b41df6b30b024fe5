#include "suspension_health_monitor/internal/record/untestable_effects.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

bool isKnown(const Records& records, BodyChannel channel) {
  const std::vector<const DriveSegment*> segments = segmentsOf(records);
  return std::none_of(segments.begin(), segments.end(), [&](const DriveSegment* segment) {
    return segment->body[static_cast<std::size_t>(channel)].empty();
  });
}

}  // namespace

std::vector<std::pair<std::string, BodyChannel>> takeUntestable(EffectLibrary& library, const Records& records) {
  std::vector<std::pair<std::string, BodyChannel>> untestable;
  std::vector<MeasurementEffect> testable;
  for (const MeasurementEffect& effect : library.readings) {
    const bool any = std::any_of(effect.channels.begin(), effect.channels.end(),
                                 [&](BodyChannel channel) { return isKnown(records, channel); });
    if (any || effect.channels.empty())
      testable.push_back(effect);
    else
      untestable.emplace_back(effect.name, effect.channels.front());
  }
  library.readings = testable;
  return untestable;
}

std::optional<std::pair<std::string, BodyChannel>> findUntestable(const StrutModel& model, const Records& records) {
  ReadingSizes sizes{1.0, 1.0, 1.0, {}};
  for (std::size_t c = 0; c < kNumBodyChannels; ++c) sizes.body[c] = isKnown(records, static_cast<BodyChannel>(c));
  for (const auto& [effect, coefficients] : model.reading) {
    const auto missing = std::find_if(effect.channels.begin(), effect.channels.end(),
                                      [&](BodyChannel channel) { return !isKnown(records, channel); });
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      if (coefficients[i] != 0.0 && !std::isfinite(effect.scale(sizes, i))) return std::pair(effect.name, *missing);
  }
  return std::nullopt;
}

}  // namespace suspension_health_monitor
