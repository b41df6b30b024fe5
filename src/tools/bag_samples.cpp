#include "bag_samples.h"

#include <optional>

#include "../ros/conversions.h"
#include "../ros/imu_mount.h"
#include "suspension_health_monitor/signal/uniform_grid.h"

namespace suspension_health_monitor {

void readSamples(const ImuBags& bags, const PipelineOptions& options,
                 const std::function<bool(const CornerSample&)>& take,
                 const std::function<void(const BodyMotion&)>& take_body) {
  std::array<ImuMount, kMostStreams> mounts = ImuMount::of(options.shell, bags.transforms.get());
  GridOptions grid_options = options.grid(*options.monitor.sample_period);
  grid_options.has_road = false;
  UniformGrid grid(*options.monitor.sample_period, grid_options);
  Stamp last_body{};
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    if (side == Side::kRoad) return true;
    const auto acceleration = mounts[static_cast<std::size_t>(side)].acceleration(imu);
    const double* const value = std::get_if<double>(&acceleration);
    if (value == nullptr) return true;
    std::optional<CornerSample> sample = grid.push(side, toStamp(imu.header.stamp), *value);
    if (take_body && side == Side::kSprung && toStamp(imu.header.stamp) > last_body) {
      last_body = toStamp(imu.header.stamp);
      take_body(mounts[0].across(imu));
    }
    for (; sample; sample = grid.next())
      if (!take(*sample)) return false;
    return true;
  });
}

}  // namespace suspension_health_monitor
