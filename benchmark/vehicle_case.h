#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/vehicle.h"
#include "vehicle_drive.h"

namespace suspension_health_monitor {

/// How a vehicle of the battery is measured.
struct Setup {
  double rate = 100.0;        // [Hz]
  double seconds = 120.0;     // [s]; the table of health takes its own
  bool has_body_imu = false;  // one six-axis IMU instead of one at the top of every strut
};

/// A law that is hidden in a strut, as strong as 15 % of the rms of the strut's force.
struct Hidden {
  const char* name;
  double (*shape)(double travel, double rate, double friction);  ///< of travel and rate over their rms
};

inline constexpr std::array<Hidden, 5> kHidden{
    Hidden{"progressive_spring", [](double d, double, double) { return d * d * d; }},
    Hidden{"friction", [](double, double v, double steep) { return std::tanh(steep * v); }},
    Hidden{"quadratic_damping", [](double, double v, double) { return v * std::abs(v); }},
    Hidden{"asymmetric_damping", [](double, double v, double) { return std::max(v, 0.0); }},
    Hidden{"asymmetric_spring", [](double d, double, double) { return std::max(d, 0.0); }}};
inline constexpr double kShare = 0.15, kSlip = 0.005;  // of the force; rate at which friction turns round [m/s]

/// One simulated drive and who drove it.
struct Driven {
  vehicle_drive::Vehicle vehicle;
  vehicle_drive::Drive options;
  vehicle_drive::Record record;
  std::vector<std::string> names;

  std::size_t size() const { return vehicle.struts.size(); }
  double period() const { return 1.0 / options.rate; }

  VehicleDrive asMeasured() const {
    VehicleDrive drive = options.imu ? byBodyImu() : VehicleDrive{byOwnImus()};
    for (const vehicle_drive::Strut& strut : vehicle.struts) drive.places.push_back({strut.x, strut.y});
    return drive;
  }
  VehicleDrive withForce() const { return {byOwnImus(), {{"pull", record.pull}}}; }

 private:
  StrutDrives byOwnImus() const {
    StrutDrives drive;
    for (std::size_t i = 0; i < size(); ++i) drive.push_back(makeDrive(period(), record.body[i], record.wheel[i]));
    return drive;
  }
  VehicleDrive byBodyImu() const;
};

/// The way of bags and topics: messages of one sensor after another through the grid.
inline VehicleDrive Driven::byBodyImu() const {
  VehicleLayout layout;
  layout.body_imu = "/imu";
  for (std::size_t i = 0; i < size(); ++i) {
    const vehicle_drive::Strut& strut = vehicle.struts[i];
    const std::array<double, 3> position{strut.x - options.imu->x, strut.y - options.imu->y, 0.0};
    layout.struts.push_back({names[i], "/" + names[i], {}, position, {}});
  }
  VehicleDrive drive{StrutDrives(size())};
  VehicleGrid grid(period(), VehicleStreams(layout), {}, [&](const VehicleSample& sample) { append(sample, drive); });
  constexpr double kGravity = 9.81;  // in the readings of all IMUs
  for (std::size_t k = 0; k < record.wheel.front().size(); ++k) {
    const Stamp stamp = fromSeconds(1.0 + static_cast<double>(k) * period());
    grid.push(0, stamp, {0.0, 0.0, kGravity + record.imu[0][k], record.imu[1][k], record.imu[2][k], 0.0});
    for (std::size_t i = 0; i < size(); ++i) grid.push(1 + i, stamp, {kGravity + record.wheel[i][k]});
  }
  grid.finish();
  grid.describe(drive);
  return drive;
}

inline Driven prepared(const char* kind, unsigned seed, const Setup& how) {
  Driven driven{vehicle_drive::made(kind, seed), {}, {}, {}};
  driven.options.seed = seed;
  driven.options.rate = how.rate;
  driven.options.seconds = how.seconds;
  driven.options.tracks = seed % 2 == 1 ? vehicle_drive::Tracks::kCoherent : vehicle_drive::Tracks::kIndependent;
  for (std::size_t i = 0; i < driven.size(); ++i) driven.names.push_back("strut" + std::to_string(i));
  const vehicle_drive::Strut& front = driven.vehicle.struts.front();
  if (how.has_body_imu) driven.options.imu = {-0.3 * front.x, 0.2 * front.y};
  return driven;
}

inline void drive(Driven& driven) { driven.record = vehicle_drive::drive(driven.vehicle, driven.options); }

inline const Hidden& lawOf(unsigned seed) { return kHidden[seed % kHidden.size()]; }
inline std::size_t placeOf(unsigned seed, std::size_t struts) { return seed / kHidden.size() % struts; }

/// Hides a law in a strut, by what the strut did before.
inline void hide(Driven& driven, const Hidden& law, std::size_t at) {
  const double travel = driven.record.travel[at], rate = driven.record.travel_rate[at], steep = rate / kSlip;
  double square = 0.0;
  constexpr int kDraws = 20000;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < kDraws; ++i) square += std::pow(law.shape(normal(random), normal(random), steep), 2) / kDraws;
  const double size = kShare * driven.record.force[at] / std::sqrt(square);
  driven.options.hidden.resize(driven.size());
  driven.options.hidden[at] = [=](double d, double v, double) { return size * law.shape(d / travel, v / rate, steep); };
}

}  // namespace suspension_health_monitor
