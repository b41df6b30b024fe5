#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

#include <algorithm>
#include <utility>

namespace suspension_health_monitor {

VehicleGrid::VehicleGrid(double period, const VehicleStreams& streams, const GridOptions& options, Sink sink)
    : tops_(fromSeconds(period), streams.channels),
      grid_(period, streams.options, options.alignment, options.fill_samples + 2 * tops_.delay()),
      sink_(std::move(sink)) {
  for (const VehicleStreams::Imu& imu : streams.imus) {
    std::size_t end = imu.stream;
    while (end < streams.options.size() && streams.options[end].sensor == streams.options[imu.stream].sensor) ++end;
    channels_.push_back({imu.stream, end});
  }
}

void VehicleGrid::push(std::size_t imu, Stamp stamp, const std::vector<double>& values) {
  std::size_t stream = channels_[imu].first;
  for (const double value : values)
    for (auto instant = grid_.push(stream++, stamp, value); instant != nullptr; instant = grid_.next())
      if (const VehicleSample* sample = tops_.push(*instant)) sink_(*sample);
}

RejectCounts VehicleGrid::rejected(std::size_t imu) const {
  RejectCounts all;
  for (std::size_t stream = channels_[imu].first; stream < channels_[imu].end; ++stream) all += grid_.rejected(stream);
  return all;
}

std::uint64_t VehicleGrid::missed(std::size_t imu) const {
  std::uint64_t most = 0;
  for (std::size_t stream = channels_[imu].first; stream < channels_[imu].end; ++stream)
    most = std::max(most, grid_.missed(stream));
  return most;
}

}  // namespace suspension_health_monitor
