#include "strut_sensors.h"

#include <variant>

namespace suspension_health_monitor {

std::optional<double> StrutSensors::read(Side side, const sensor_msgs::Imu& imu) {
  const auto acceleration = mounts_[static_cast<std::size_t>(side)].acceleration(imu);
  if (const double* along = std::get_if<double>(&acceleration)) return *along;
  rejected_.add(std::get<RejectReason>(acceleration));
  return std::nullopt;
}

}  // namespace suspension_health_monitor
