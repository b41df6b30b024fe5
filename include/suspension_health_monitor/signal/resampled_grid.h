#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/signal/alignment.h"
#include "suspension_health_monitor/signal/reject_reason.h"
#include "suspension_health_monitor/signal/stream_resampler.h"

namespace suspension_health_monitor {

/// Samples of a strut at the instants of a uniform grid, every stream by a StreamResampler. They come
/// StreamResampler::kHalfWidth periods late, as soon as all streams reach so far ahead.
///
/// A pause of up to kLongestBridge periods (the grid's or the stream's own, whichever is longer) is bridged; after a
/// longer one the grid starts anew as soon as all windows are full, on the same multiples of T. The result does not
/// depend on the order in which the streams interleave, as long as none runs further ahead than its ring holds.
/// Cost per reading: O(1) amortised (a reading is in 2 kHalfWidth windows), no allocation.
class ResampledGrid {
 public:
  static constexpr double kLongestBridge = 4.5;  ///< three lost readings in a row, and jitter

  /// @param period  T > 0.
  ResampledGrid(Stamp period, bool has_road);

  /// Takes in the next reading of a stream.
  /// @param still  StreamGate::isStill().  @param own_period  mean spacing of the stream [s]; 0: not known yet.
  void push(Side side, Stamp stamp, double acceleration, bool still, double own_period);

  /// @return the next sample that the readings so far complete.
  std::optional<CornerSample> next();

  /// @return the road's acceleration at the sample given last [m/s^2].
  std::optional<double> roadAcceleration() const { return road_acceleration_; }

  /// Forgets all readings.
  void startNewSeries();

  const RejectCounts& rejected() const { return rejected_; }

  /// @return lost readings that were interpolated over, of all streams.
  std::uint64_t bridged() const { return bridged_; }

 private:
  static constexpr int kMostRoadLag = 64;  // [periods]

  StreamResampler& stream(Side side) { return streams_[static_cast<std::size_t>(side)]; }
  bool begin();
  bool findRoad(Stamp t);

  Stamp period_;
  bool has_road_;
  std::array<StreamResampler, kMostStreams> streams_;
  std::optional<Stamp> origin_;  // of the series
  std::optional<Stamp> next_;
  bool road_is_silent_ = false;
  std::optional<double> road_acceleration_;
  std::uint64_t bridged_ = 0;
  RejectCounts rejected_;
};

}  // namespace suspension_health_monitor
