#pragma once

#include <boost/circular_buffer.hpp>
#include <cstddef>

#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

/// One reading of one stream that has passed its StreamGate.
struct SensorReading {
  Stamp stamp{};
  Stamp taken{};               ///< when it was taken, by StreamClock
  double value = 0.0;          ///< in the stream's unit
  bool still = false;          ///< StreamGate::isStill()
  double usual_spacing = 0.0;  ///< StreamClock::period() of its stream by then [s]; 0: not known yet
};

inline constexpr std::size_t kMostWaiting = 4096;  ///< readings of one stream for those of another

/// Readings of one stream that wait for those of another: first in, first out, of fixed capacity, kMostWaiting.
using ReadingQueue = boost::circular_buffer<SensorReading>;

}  // namespace suspension_health_monitor
