#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/stream_grid.h"

namespace suspension_health_monitor {

/// A StreamGrid of the two or three sensors of one strut, whose streams are numbered by Side.
class UniformGrid {
 public:
  static constexpr std::size_t kMostWaiting = StreamGrid::kMostWaiting;

  /// @param period  sampling time T > 0 [s].
  explicit UniformGrid(double period, const GridOptions& options = {});

  /// As StreamGrid::push().
  /// @param side  the road's readings are left out without GridOptions::has_road.
  /// @param acceleration  along the strut, up positive [m/s^2].
  /// @return the first sample that this reading completes, stamped by the sprung sensor or, resampled, by the grid.
  std::optional<CornerSample> push(Side side, Stamp stamp, double acceleration);

  /// @return the next sample that the readings so far complete.
  std::optional<CornerSample> next() { return take(streams_.next()); }

  /// @return the road's acceleration at the sample given last [m/s^2]; none without a reading near it.
  std::optional<double> roadAcceleration() const { return road_acceleration_; }

  /// As those of StreamGrid.
  bool resamples() const { return streams_.resamples(); }
  std::string why() const { return streams_.why(); }
  std::string whatIsTooSlow() const { return streams_.whatIsTooSlow(); }
  std::string describeAlignment() const { return streams_.describeAlignment(); }
  std::uint64_t bridged() const { return streams_.bridged(); }
  RejectCounts rejected() const { return streams_.rejected(); }
  const std::optional<Stamp>& taken() const { return streams_.taken(); }
  const StreamGate& gate(Side side) const { return streams_.gate(indexOf(side)); }

 private:
  std::optional<CornerSample> take(const GridInstant* instant);

  bool has_road_;
  StreamGrid streams_;
  std::optional<double> road_acceleration_;
};

}  // namespace suspension_health_monitor
