#include "suspension_health_monitor/internal/signal/grid_streams.h"

#include <algorithm>
#include <stdexcept>

namespace suspension_health_monitor {

GridStreams::GridStreams(Stamp period, const std::vector<StreamOptions>& options) {
  const auto reference =
      std::find_if(options.begin(), options.end(), [](const StreamOptions& o) { return o.required; });
  if (reference == options.end()) throw std::invalid_argument("of the streams of a grid at least one must be required");
  reference_ = static_cast<std::size_t>(reference - options.begin());
  std::size_t sensors = 0;
  streams_.reserve(options.size());
  for (const StreamOptions& each : options) {
    streams_.emplace_back(period, each);
    sensors = std::max(sensors, each.sensor + 1);
  }
  sensor_is_still_.resize(sensors);
}

bool GridStreams::areWaiting() const {
  return std::none_of(streams_.begin(), streams_.end(),
                      [](const GridStream& stream) { return stream.options.required && stream.waiting.empty(); });
}

bool GridStreams::mayStillCome(GridStream& optional) const {
  const ReadingQueue& waiting = streams_[reference_].waiting;
  const Stamp lag = waiting.empty() ? Stamp::zero() : waiting.back().stamp - waiting.front().stamp;
  if (waiting.full() || lag > kMostOptionalLag) optional.is_silent = true;
  return !optional.is_silent;
}

bool GridStreams::rejectStuck() {
  std::fill(sensor_is_still_.begin(), sensor_is_still_.end(), true);
  const auto isCompared = [](const GridStream& stream) { return stream.options.required && !stream.options.is_force; };
  for (const GridStream& stream : streams_)
    if (isCompared(stream) && !stream.is_still) sensor_is_still_[stream.options.sensor] = false;
  const auto standsStill = [&](const GridStream& stream) {
    return isCompared(stream) && sensor_is_still_[stream.options.sensor];
  };
  const auto moves = [&](const GridStream& stream) {
    return isCompared(stream) && !sensor_is_still_[stream.options.sensor];
  };
  if (std::none_of(streams_.begin(), streams_.end(), standsStill) ||
      std::none_of(streams_.begin(), streams_.end(), moves))
    return false;
  for (GridStream& stream : streams_)
    if (standsStill(stream)) stream.rejected.add(RejectReason::kStuck);
  return true;
}

}  // namespace suspension_health_monitor
