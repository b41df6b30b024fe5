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
  std::optional<BodyFitResult> body;
  std::vector<std::optional<WindowEstimate>> over_the_drive;
};

inline vehicle_drive::Drive shortDrive(double seconds = 60.0) {
  vehicle_drive::Drive drive;
  drive.seconds = seconds;
  return drive;
}

inline VehicleTops topsOf(const vehicle_drive::Vehicle& vehicle, const vehicle_drive::Drive& drive) {
  VehicleTops tops;
  for (const vehicle_drive::Strut& strut : vehicle.struts) {
    VehicleTops::Top top;
    top.has_own = !drive.imu;
    if (drive.imu) top.position = Eigen::Vector3d(strut.x - drive.imu->x, strut.y - drive.imu->y, 0.0);
    tops.tops.push_back(top);
  }
  tops.known_forces = drive.pull > 0.0 ? 1 : 0;
  return tops;
}

/// @param change  what the file says wrongly, or a sensor does.
inline Told tell(const vehicle_drive::Vehicle& vehicle, const vehicle_drive::Drive& drive,
                 const std::function<void(vehicle_drive::Record&, VehicleTops&)>& change = {}) {
  constexpr double kGravity = 9.81;
  vehicle_drive::Record record = vehicle_drive::drive(vehicle, drive);
  VehicleTops tops = topsOf(vehicle, drive);
  if (change) change(record, tops);
  const std::size_t n = vehicle.struts.size();
  VehicleBlocks blocks(tops, BlockOptions{}, 1.0 / drive.rate);
  Told told;
  told.estimates.resize(n);
  const auto keep = [&](const TopEstimate* estimate) {
    if (estimate != nullptr) told.estimates[estimate->strut].push_back(*estimate);
  };
  for (std::size_t k = 0; k < record.wheel.front().size(); ++k) {
    const Stamp stamp = fromSeconds(100.0 + static_cast<double>(k) / drive.rate);
    if (drive.imu)
      keep(blocks.pushBody(stamp, {0.0, 0.0, kGravity + record.imu[0][k]}, {record.imu[1][k], record.imu[2][k], 0.0}));
    for (std::size_t i = 0; i < n; ++i) {
      if (!drive.imu) keep(blocks.pushTop(i, stamp, kGravity + record.body[i][k]));
      keep(blocks.pushWheel(i, stamp, kGravity + record.wheel[i][k]));
    }
    if (drive.pull > 0.0) keep(blocks.pushForce(0, stamp, record.pull[k]));
  }
  for (std::size_t i = 0; i < n; ++i) told.over_the_drive.push_back(blocks.overTheDrive(i));
  told.mistake = blocks.claims().find();
  if (BodyRows rows; blocks.rows(rows)) told.body = BodyFit::of(n, tops.places()).fit(rows, blocks.rowsOfHalves());
  return told;
}

}  // namespace suspension_health_monitor
