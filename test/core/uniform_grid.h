#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/stream_grid.h"

namespace suspension_health_monitor {

// One sensor each, in the order of Side.
inline std::vector<StreamOptions> streamsOf(bool has_road) {
  std::vector<StreamOptions> streams{{indexOf(Side::kSprung), true}, {indexOf(Side::kUnsprung), true}};
  if (has_road) streams.push_back({indexOf(Side::kRoad), false});
  return streams;
}

/// A StreamGrid of the two or three sensors of one strut, whose streams are numbered by Side.
class UniformGrid {
 public:
  /// @param period  sampling time T > 0 [s].
  /// @param has_road  there is a third stream, Side::kRoad.
  explicit UniformGrid(double period, const GridOptions& options = {}, bool has_road = false);

  /// As StreamGrid::push().
  /// @param side  the road's readings are left out without has_road.
  /// @param acceleration  along the strut, up positive [m/s^2].
  /// @return the first sample that this reading completes, stamped by the sprung sensor or, resampled, by the grid.
  std::optional<CornerSample> push(Side side, Stamp stamp, double acceleration);

  /// @return the next sample that the readings so far complete.
  std::optional<CornerSample> next() { return take(streams_.next()); }

  /// @return the road's acceleration at the sample given last [m/s^2]; none without a reading near it.
  std::optional<double> roadAcceleration() const { return road_acceleration_; }

  const StreamGrid& streams() const { return streams_; }
  const StreamGate& gate(Side side) const { return streams_.gate(indexOf(side)); }

 private:
  std::optional<CornerSample> take(const GridInstant* instant);

  bool has_road_;
  StreamGrid streams_;
  std::optional<double> road_acceleration_;
};

inline UniformGrid::UniformGrid(double period, const GridOptions& options, bool has_road)
    : has_road_(has_road), streams_(period, streamsOf(has_road), options.alignment, options.fill_samples) {}

inline std::optional<CornerSample> UniformGrid::push(Side side, Stamp stamp, double acceleration) {
  if (side == Side::kRoad && !has_road_) return std::nullopt;
  return take(streams_.push(indexOf(side), stamp, acceleration));
}

inline std::optional<CornerSample> UniformGrid::take(const GridInstant* instant) {
  if (instant == nullptr) return std::nullopt;
  const std::vector<double>& values = instant->values;
  const bool has_road = has_road_ && instant->measured[indexOf(Side::kRoad)];
  road_acceleration_ = has_road ? std::optional<double>(values[indexOf(Side::kRoad)]) : std::nullopt;
  return CornerSample{instant->stamp, values[indexOf(Side::kSprung)], values[indexOf(Side::kUnsprung)]};
}

}  // namespace suspension_health_monitor
