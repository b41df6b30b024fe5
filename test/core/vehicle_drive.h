#pragma once

#include <string>
#include <vector>

#include "simulated_vehicle.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// A simulated drive as recorded ones are: what the IMUs at every strut's top and wheel read, and the known forces.
inline VehicleDrive vehicleDriveOf(const Vehicle& vehicle, const VehicleDriveOptions& options) {
  VehicleDrive drive{StrutDrives(vehicle.struts.size())};
  for (const KnownForce& force : vehicle.known_forces) drive.forces.push_back({force.name, {}});
  for (const VehicleInstant& instant : driveVehicle(vehicle, options)) {
    for (std::size_t i = 0; i < drive.struts.size(); ++i)
      drive.struts[i].samples.push_back({instant.stamp, instant.struts[i].sprung->acceleration + options.gravity,
                                         instant.struts[i].unsprung->acceleration + options.gravity});
    for (std::size_t k = 0; k < drive.forces.size(); ++k) drive.forces[k].values.push_back(instant.known_forces[k]);
  }
  return drive;
}

/// The same without the forces.
inline StrutDrives strutDrives(const Vehicle& vehicle, const VehicleDriveOptions& options) {
  return vehicleDriveOf(vehicle, options).struts;
}

inline std::vector<std::string> strutNames(const Vehicle& vehicle) {
  std::vector<std::string> names;
  for (const VehicleStrut& strut : vehicle.struts) names.push_back(strut.name);
  return names;
}

/// The same drive with one six-axis IMU on the body instead of those at the strut tops, through the grid.
inline VehicleDrive bodyImuDrive(const Vehicle& vehicle, const VehicleDriveOptions& options) {
  VehicleLayout layout;
  layout.body_imu = "/imu";
  const VehicleImu& imu = vehicle.body_imu;
  for (const VehicleStrut& strut : vehicle.struts)
    layout.struts.push_back(
        {strut.name, "/" + strut.name, {}, {{strut.x - imu.x, strut.y - imu.y, strut.z - imu.z}}, {}});
  VehicleDrive drive{StrutDrives(vehicle.struts.size())};
  VehicleGrid grid(1.0 / options.rate, VehicleStreams(layout), {},
                   [&](const VehicleSample& sample) { append(sample, drive); });
  for (const VehicleInstant& instant : driveVehicle(vehicle, options)) {
    const Eigen::Vector3d &a = instant.body->acceleration, &w = instant.body->angular_rate;
    grid.push(0, instant.stamp, {a[0], a[1], a[2], w[0], w[1], w[2]});
    for (std::size_t i = 0; i < drive.struts.size(); ++i)
      grid.push(1 + i, instant.stamp, {instant.struts[i].unsprung->acceleration + options.gravity});
  }
  grid.finish();
  grid.describe(drive);
  drive.places = grid.vehicle().places();
  return drive;
}

/// rho_ij of a vehicle, by Newton's law of its body.
inline double ratioOf(const Vehicle& vehicle, std::size_t i, std::size_t j) {
  return vehicle.mobility(vehicle.struts[i], vehicle.struts[j]) /
         vehicle.mobility(vehicle.struts[j], vehicle.struts[j]);
}

}  // namespace suspension_health_monitor
