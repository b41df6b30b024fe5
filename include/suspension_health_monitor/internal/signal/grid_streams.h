#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/signal/stream_gate.h"

namespace suspension_health_monitor {

/// What a stream is to a StreamGrid.
struct StreamOptions {
  /// The streams of one sensor share its stamps, as the six channels of an IMU do. A sensor is still if all of its
  /// streams are: a vehicle that drives straight on turns about no axis.
  std::size_t sensor = 0;
  /// Every instant needs a reading of this stream. The grid waits for the other streams until the readings of the
  /// reference that wait span more than kMostOptionalLag.
  bool required = true;
  /// A force may rest while the vehicle moves, stay at an end of its range, and have any unit: it is not judged by what
  /// accelerations are like.
  bool is_force = false;
};
inline constexpr Stamp kMostOptionalLag = std::chrono::seconds(1);  ///< half of the usual input_timeout

/// The values of all streams of a StreamGrid at one instant.
struct GridInstant {
  Stamp stamp{};
  std::vector<double> values;  ///< by stream
  std::vector<bool> measured;  ///< by stream; false: an optional one without a reading near, whose value is old
};

/// One stream of a StreamGrid, and what has become of its readings.
struct GridStream {
  StreamOptions options;
  StreamGate gate;
  ReadingQueue waiting = ReadingQueue(kMostWaiting);
  RejectCounts rejected = {};  ///< of those that passed the gate
  std::uint64_t missed = 0;    ///< readings of others and instants that were lost for want of a reading of this stream
  bool is_silent = false;      ///< optional, and is not waited for until it comes again
  bool is_still = false;       ///< at the instant at hand

  /// Drops the oldest reading that waits: it has no partner.
  void drop() {
    rejected.add(RejectReason::kMissingPartner);
    waiting.pop_front();
  }
};

}  // namespace suspension_health_monitor
