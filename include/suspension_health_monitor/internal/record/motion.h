#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

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

/// How far and how fast a strut moves on a drive: what shape parameters are measured in (ShapeScale).
struct MotionScale {
  double travel = 0.0;       ///< rms of d less its mean [m]
  double travel_rate = 0.0;  ///< rms of v [m/s]
  double time = 0.0;         ///< 1/sqrt(b0) [s]

  /// @return one unit of the scale in SI.
  double unit(ShapeScale scale) const;
};

/// @return true if a shape of the effect lies within a hundredth of its range (in the logarithm) of an end that is not
/// open, or beyond.
bool hasShapeAtEnd(const ActiveEffect& active, const MotionScale& scale);

/// The scale of a drive by a free run of the linear strut over its samples.
/// @param samples  in the order of time; the run starts anew at gaps.  @param period  sampling time T [s].
/// @return nothing if the model is not stable or nothing moves long enough for the run to settle.
std::optional<MotionScale> motionScale(const std::vector<CornerSample>& samples, double period, double damping_to_mass,
                                       double stiffness_to_mass);

}  // namespace suspension_health_monitor
