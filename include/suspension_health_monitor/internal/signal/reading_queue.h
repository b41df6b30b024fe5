#pragma once

#include <array>
#include <boost/circular_buffer.hpp>
#include <cstddef>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/signal/alignment.h"

namespace suspension_health_monitor {

/// One reading of one sensor that has passed its StreamGate.
struct SensorReading {
  Stamp stamp{};
  double acceleration = 0.0;
  bool still = false;          ///< StreamGate::isStill()
  double usual_spacing = 0.0;  ///< StreamTiming::period() of its sensor by then [s]; 0: not known yet
};

/// Readings of one sensor that wait for those of another: first in, first out, of fixed capacity.
struct ReadingQueue : boost::circular_buffer<SensorReading> {
  static constexpr std::size_t kCapacity = 4096;
  ReadingQueue() : circular_buffer(kCapacity) {}
};

/// Of the sensors of a strut.
class WaitingReadings {
 public:
  ReadingQueue& operator[](Side side) { return queues_[static_cast<std::size_t>(side)]; }

 private:
  std::array<ReadingQueue, kMostStreams> queues_;
};

/// A road sensor, if there is one, is waited for while no more than so many readings of the body wait with it: a strut
/// does not need it.
inline constexpr std::size_t kMostRoadLag = 64;

}  // namespace suspension_health_monitor
