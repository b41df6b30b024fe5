#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "../../benchmark/vehicle_drive.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"

namespace suspension_health_monitor {

/// A drive and what was told of it.
struct Told {
  std::vector<std::vector<TopEstimate>> estimates;  // by strut
  VehicleMistake mistake;
  Eigen::ArrayXXd model_errors;  // VehicleClaims::modelErrors()
  std::optional<BodyFitResult> body;
  std::vector<std::optional<WindowEstimate>> over_the_drive;
  std::optional<double> gyro_died;  // [s] of the drive, when the blocks first said so
};

inline vehicle_drive::Drive shortDrive(double seconds = 60.0) {
  vehicle_drive::Drive drive;
  drive.seconds = seconds;
  return drive;
}

inline VehicleChannels channelsOf(const vehicle_drive::Vehicle& vehicle, const vehicle_drive::Drive& drive) {
  VehicleChannels channels = VehicleChannels::ofAccelerometers(vehicle.struts.size(), drive.pull > 0.0 ? 1 : 0);
  for (std::size_t i = 0; drive.imu && i < channels.struts.size(); ++i) {
    channels.struts[i].sprung.reset();
    channels.struts[i].position =
        Eigen::Vector3d(vehicle.struts[i].x - drive.imu->x, vehicle.struts[i].y - drive.imu->y, 0.0);
  }
  return channels;
}

/// @param change  what the file says wrongly, or a sensor does.  @param late  the stamps of all wheels [s].
inline Told tell(const vehicle_drive::Vehicle& vehicle, const vehicle_drive::Drive& drive,
                 const std::function<void(vehicle_drive::Record&, VehicleChannels&)>& change = {}, double late = 0.0) {
  using Sensor = VehicleReading::Sensor;
  constexpr double kGravity = 9.81;
  vehicle_drive::Record record = vehicle_drive::drive(vehicle, drive);
  VehicleChannels channels = channelsOf(vehicle, drive);
  if (change) change(record, channels);
  const std::size_t n = vehicle.struts.size();
  VehicleBlocks blocks(channels, 1.0 / drive.rate);
  Told told;
  told.estimates.resize(n);
  const auto keep = [&](const TopEstimate* estimate) {
    if (estimate != nullptr) told.estimates[estimate->strut].push_back(*estimate);
  };
  for (std::size_t k = 0; k < record.wheel.front().size(); ++k) {
    const Stamp stamp = fromSeconds(100.0 + static_cast<double>(k) / drive.rate);
    if (drive.imu)
      keep(blocks.push(
          {Sensor::kBody, 0, stamp, {0.0, 0.0, kGravity + record.imu[0][k], record.imu[1][k], record.imu[2][k], 0.0}}));
    for (std::size_t i = 0; i < n; ++i) {
      if (channels.struts[i].sprung) keep(blocks.push({Sensor::kSprung, i, stamp, {kGravity + record.body[i][k]}}));
      keep(blocks.push({Sensor::kUnsprung, i, stamp + fromSeconds(late), {kGravity + record.wheel[i][k]}}));
    }
    if (drive.pull > 0.0) keep(blocks.push({Sensor::kForce, 0, stamp, {record.pull[k]}}));
    if (!told.gyro_died && blocks.hasDeadGyro()) told.gyro_died = static_cast<double>(k) / drive.rate;
  }
  for (std::size_t i = 0; i < n; ++i) told.over_the_drive.push_back(blocks.overTheDrive(i));
  VehicleClaims claims = blocks.claims();
  told.mistake = claims.find();
  told.model_errors = claims.modelErrors();
  if (BodyRows rows; blocks.rows(rows)) told.body = fitRigidBody(rows, channels.places(), blocks.rowsOfHalves());
  return told;
}

}  // namespace suspension_health_monitor
