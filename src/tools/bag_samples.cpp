#include "bag_samples.h"

#include <optional>

#include "../ros/conversions.h"
#include "suspension_health_monitor/signal/uniform_grid.h"

namespace suspension_health_monitor {

void readSamples(const ImuBags& bags, const PipelineOptions& options,
                 const std::function<bool(const CornerSample&)>& take,
                 const std::function<void(const BodyMotion&)>& take_body) {
  const std::array<StrutAxis, 2> axes{StrutAxis(options.shell.sprung_axis), StrutAxis(options.shell.unsprung_axis)};
  UniformGrid grid(*options.monitor.sample_period);
  Stamp last_body{};
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    const std::optional<double> acceleration = axes[static_cast<std::size_t>(side)].acceleration(imu);
    std::optional<CornerSample> sample =
        acceleration ? grid.push(side, toStamp(imu.header.stamp), *acceleration) : std::nullopt;
    if (take_body && side == Side::kSprung && toStamp(imu.header.stamp) > last_body) {
      last_body = toStamp(imu.header.stamp);
      take_body(axes[0].across(imu));
    }
    for (; sample; sample = grid.next())
      if (!take(*sample)) return false;
    return true;
  });
}

}  // namespace suspension_health_monitor
