#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

#include <algorithm>
#include <utility>

namespace suspension_health_monitor {

VehicleGrid::VehicleGrid(double period, const VehicleStreams& streams, const GridOptions& options, Sink sink)
    : tops_(fromSeconds(period), streams.channels),
      grid_(period, streams.options, options.alignment, options.fill_samples + 2 * tops_.delay()),
      sink_(std::move(sink)) {
  for (const VehicleStreams::Sensor& sensor : streams.sensors) {
    std::size_t end = sensor.stream;
    while (end < streams.options.size() && streams.options[end].sensor == streams.options[sensor.stream].sensor) ++end;
    channels_.push_back({sensor.stream, end});
  }
}

void VehicleGrid::push(std::size_t sensor, Stamp stamp, const std::vector<double>& values) {
  std::size_t stream = channels_[sensor].first;
  for (const double value : values)
    for (auto instant = grid_.push(stream++, stamp, value); instant != nullptr; instant = grid_.next())
      if (const VehicleSample* sample = tops_.push(*instant)) sink_(*sample);
}

RejectCounts VehicleGrid::rejected(std::size_t sensor) const {
  RejectCounts all;
  for (std::size_t stream = channels_[sensor].first; stream < channels_[sensor].end; ++stream)
    all += grid_.rejected(stream);
  return all;
}

std::uint64_t VehicleGrid::missed(std::size_t sensor) const {
  std::uint64_t most = 0;
  for (std::size_t stream = channels_[sensor].first; stream < channels_[sensor].end; ++stream)
    most = std::max(most, grid_.missed(stream));
  return most;
}

}  // namespace suspension_health_monitor
