#include "bag_samples.h"

#include <optional>

#include "../ros/conversions.h"
#include "suspension_health_monitor/signal/uniform_grid.h"

namespace suspension_health_monitor {

void readSamples(const ImuBags& bags, const PipelineOptions& options,
                 const std::function<bool(const CornerSample&)>& take) {
  const std::array<StrutAxis, 2> axes{StrutAxis(options.shell.sprung_axis), StrutAxis(options.shell.unsprung_axis)};
  UniformGrid grid(*options.monitor.sample_period);
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    const std::optional<double> acceleration = axes[static_cast<std::size_t>(side)].acceleration(imu);
    const std::optional<CornerSample> sample =
        acceleration ? grid.push(side, toStamp(imu.header.stamp), *acceleration) : std::nullopt;
    return !sample || take(*sample);
  });
}

}  // namespace suspension_health_monitor
