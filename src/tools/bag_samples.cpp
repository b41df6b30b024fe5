#include "bag_samples.h"

#include <optional>

#include "../ros/strut_sensors.h"

namespace suspension_health_monitor {

void readSamples(const ImuBags& bags, PipelineOptions options, const std::function<bool(const CornerSample&)>& take,
                 const std::function<void(const BodyMotion&)>& take_body) {
  options.shell.tyre = false;  // a sample has no part of the road
  StrutSensors sensors(options.shell, bags.transforms.get());
  sensors.start(options, *options.monitor.sample_period);
  Stamp last_body{};
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    if (side == Side::kRoad) return true;
    const std::optional<StrutSensors::Reading> reading = sensors.read(side, imu);
    if (!reading) return true;
    if (take_body && side == Side::kSprung && reading->stamp > last_body) {
      last_body = reading->stamp;
      take_body(sensors.across(imu));
    }
    for (auto sample = sensors.push(*reading); sample; sample = sensors.next())
      if (!take(*sample)) return false;
    return true;
  });
}

}  // namespace suspension_health_monitor
