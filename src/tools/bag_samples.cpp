#include "bag_samples.h"

#include <optional>
#include <utility>

#include "../ros/conversions.h"
#include "../ros/imu_mount.h"

namespace suspension_health_monitor {

ReadSamples readSamples(const ImuBags& bags, const PipelineOptions& options,
                        const std::function<bool(const CornerSample&)>& take,
                        const std::function<void(const BodyMotion&)>& take_body) {
  StrutSensors sensors(options.shell, bags.transforms.get());
  MonitorSettings settings = options.monitor;
  settings.tyre = false;  // a sample has no part of the road
  const double period = *settings.sample_period;
  UniformGrid grid(period, settings.grid(period));
  Stamp last_body{};
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    if (side == Side::kRoad) return true;
    const std::optional<double> acceleration = sensors.read(side, imu);
    if (!acceleration) return true;
    const Stamp stamp = toStamp(imu.header.stamp);
    if (take_body && side == Side::kSprung && stamp > last_body) {
      last_body = stamp;
      take_body(sensors.across(imu));
    }
    for (auto sample = grid.push(side, stamp, *acceleration); sample; sample = grid.next())
      if (!take(*sample)) return false;
    return true;
  });
  RejectCounts rejected = sensors.rejected();
  rejected += grid.streams().rejected();
  return {grid.streams(), rejected};
}

}  // namespace suspension_health_monitor
