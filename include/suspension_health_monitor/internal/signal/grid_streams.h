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
  std::vector<bool>
      measured;  ///< by stream; false for an optional one without a reading near: its value is not to be used
};

/// One stream of a StreamGrid, and what has become of its readings.
struct GridStream {
  GridStream(Stamp period, const StreamOptions& its_options)
      : options(its_options), gate(period, its_options.is_force) {}

  /// Drops the oldest reading that waits: it has no partner.
  void drop() {
    rejected.add(RejectReason::kMissingPartner);
    waiting.pop_front();
  }

  StreamOptions options;
  StreamGate gate;
  ReadingQueue waiting{kMostWaiting};
  RejectCounts rejected;     ///< of those that passed the gate
  std::uint64_t missed = 0;  ///< readings of others and instants that were lost for want of a reading of this stream
  bool is_silent = false;    ///< optional, and is not waited for until it comes again
  bool is_still = false;     ///< at the instant at hand
};

/// All streams of a StreamGrid. The first one that is required is the reference.
class GridStreams {
 public:
  /// @throws std::invalid_argument  if no stream is required.
  GridStreams(Stamp period, const std::vector<StreamOptions>& options);

  GridStream& operator[](std::size_t stream) { return streams_[stream]; }
  const GridStream& operator[](std::size_t stream) const { return streams_[stream]; }
  std::size_t size() const { return streams_.size(); }
  auto begin() { return streams_.begin(); }
  auto end() { return streams_.end(); }
  auto begin() const { return streams_.begin(); }
  auto end() const { return streams_.end(); }

  std::size_t referenceIndex() const { return reference_; }
  GridStream& reference() { return streams_[reference_]; }

  /// @return true if a reading of every required stream waits.
  bool areWaiting() const;

  /// Whether an optional stream, none of whose readings has come, is to be waited for.
  bool mayStillCome(GridStream& optional) const;

  /// Compares GridStream::is_still of the required ones that are no forces.
  /// @return true if some sensors stand still while others move, which is then counted for those that are still.
  bool rejectStuck();

 private:
  std::vector<GridStream> streams_;
  std::size_t reference_;
  std::vector<bool> sensor_is_still_;
};

}  // namespace suspension_health_monitor
