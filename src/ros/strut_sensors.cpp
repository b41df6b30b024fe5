#include "strut_sensors.h"

#include <variant>

#include "conversions.h"

namespace suspension_health_monitor {

std::optional<StrutSensors::Reading> StrutSensors::read(Side side, const sensor_msgs::Imu& imu) {
  const auto acceleration = mounts_[static_cast<std::size_t>(side)].acceleration(imu);
  if (const RejectReason* reason = std::get_if<RejectReason>(&acceleration)) {
    rejected_.add(*reason);
    return std::nullopt;
  }
  return Reading{side, toStamp(imu.header.stamp), std::get<double>(acceleration)};
}

RejectCounts StrutSensors::rejected() const {
  RejectCounts all = rejected_;
  if (grid_) all += grid_->rejected();
  return all;
}

}  // namespace suspension_health_monitor
