#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// The frequencies between which nine tenths of the travel rate's power lie.
struct MotionRange {
  double low = 0.0, high = 0.0;  ///< [Hz]
  double resolution = 0.0;       ///< by so much the spectrum spreads one line to either side [Hz]

  /// Less than an octave: what a frequency response is elsewhere, and so a delay or a second resonance, is not seen.
  bool isOneFrequency() const { return high < 2.0 * low; }

  /// More than an octave without any doubt: a line that is spread is not.
  bool isWide() const { return high - resolution > 2.0 * (low + resolution); }
};

/// The travel rate is w'' - z'' over i omega, in windows as long as the longest segment has room for.
/// @return nothing if nothing moves, or if no segment is long enough.
std::optional<MotionRange> rangeOfMotion(const Records& records);

/// Takes out of a library what one frequency cannot tell: every fault of a reading, and every force that is linear and
/// the same at all times, so that nothing but its frequency response tells it from a spring and a damper.
/// @return their names.
std::vector<std::string> takeFrequencyResponses(EffectLibrary& library);

}  // namespace suspension_health_monitor
