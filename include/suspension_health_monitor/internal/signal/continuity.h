#pragma once

#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

/// How a sample follows the one before it in a uniform series of period T.
enum class Continuity {
  kContinues,   ///< spacing within (T/2, 3T/2)
  kTooSoon,     ///< spacing up to T/2: more samples than the period allows
  kGap,         ///< spacing of 3T/2 or more: at least one sample is missing
  kClockJumped  ///< the clock went back
};

inline Continuity continuity(Stamp spacing, Stamp period) {
  if (spacing < Stamp::zero()) return Continuity::kClockJumped;
  if (2 * spacing <= period) return Continuity::kTooSoon;
  return 2 * spacing >= 3 * period ? Continuity::kGap : Continuity::kContinues;
}

}  // namespace suspension_health_monitor
