#pragma once

#include <array>
#include <cstddef>
#include <vector>

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
class ReadingQueue {
 public:
  static constexpr std::size_t kCapacity = 4096;

  ReadingQueue() : readings_(kCapacity) {}

  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == kCapacity; }
  std::size_t size() const { return size_; }
  const SensorReading& front() const { return readings_[first_]; }

  /// @pre not full.
  void push(const SensorReading& reading) { readings_[(first_ + size_++) % kCapacity] = reading; }

  /// @pre not empty.
  void pop() {
    first_ = (first_ + 1) % kCapacity;
    --size_;
  }

 private:
  std::vector<SensorReading> readings_;
  std::size_t first_ = 0, size_ = 0;
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
