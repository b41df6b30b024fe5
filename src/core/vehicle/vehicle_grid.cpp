#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {

VehicleGrid::VehicleGrid(double period, const VehicleStreams& streams, const GridOptions& options, Sink sink,
                         ReadingSink readings)
    : period_(fromSeconds(period)),
      vehicle_(streams.channels),
      tops_(period_, streams.channels),
      grid_(period, streams.options, options.alignment, options.fill_samples + 2 * tops_.delay()),
      sensors_(streams.sensors),
      body_levels_(streams.channels.body_imu ? 6 : 0, WhiteLevel(1.0 - 1.0 / kVehicleTuning.noise_memory)),
      sink_(std::move(sink)),
      readings_(std::move(readings)) {
  // Gaps cost a level some instants.
  if (vehicle_.body_imu)
    level_window_ =
        std::max(static_cast<std::size_t>(std::ceil(kVehicleTuning.part * kVehicleTuning.fewest_parts / period)),
                 2 * kVehicleTuning.fewest_of_noise);
  num_to_wait_ = level_window_;
  waiting_.reserve(kVehicleTuning.most_windows * level_window_);
}

bool VehicleGrid::push(std::size_t sensor, Stamp stamp, const double* values) {
  const bool did_pair = !grid_.resamples();
  const VehicleStreams::Sensor& its = sensors_[sensor];
  bool is_taken = true;
  for (std::size_t i = 0; i < its.count; ++i) {
    auto instant = grid_.push(its.stream + i, stamp, values[i]);
    const std::optional<Stamp>& taken = grid_.gate(its.stream + i).taken();
    is_taken = is_taken && taken;
    if (is_taken && i + 1 == its.count) lead(its, values, *taken);
    for (; instant != nullptr; instant = grid_.next()) take(*instant);
  }
  return did_pair && grid_.resamples();
}

void VehicleGrid::lead(const VehicleStreams::Sensor& sensor, const double* values, Stamp taken) {
  if (!readings_ || sensor.place == Place::kRoad) return;
  if (sensor.place == Place::kForce) {
    for (std::size_t i = 0; i < sensor.count; ++i) give({Place::kForce, sensor.forces[i], taken, {values[i]}});
    return;
  }
  VehicleReading reading{sensor.place, sensor.strut, taken, {}};
  std::copy_n(values, sensor.count, reading.values.begin());
  give(reading);
}

void VehicleGrid::give(VehicleReading reading) {
  if (num_to_wait_ > 0) {
    waiting_readings_.push_back(reading);
    return;
  }
  if (reading.sensor == Place::kBody) {
    Eigen::Map<Eigen::Vector3d> acceleration(reading.values.data()), rate(reading.values.data() + 3);
    acceleration = vehicle_.body_mount * acceleration.eval() / level_.gain;
    rate = vehicle_.body_mount * rate.eval();
  }
  readings_(reading);
}

void VehicleGrid::take(const GridInstant& instant) {
  const bool continues = last_ && continuity(instant.stamp - *last_, period_) == Continuity::kContinues;
  last_ = instant.stamp;
  ++num_instants_;
  for (std::size_t axis = 0; axis < body_levels_.size(); ++axis) {
    if (!continues) body_levels_[axis].startNewSeries();
    body_levels_[axis].add(instant.values[*vehicle_.body_imu + axis]);
  }
  if (num_to_wait_ == 0) return lead(instant);
  waiting_.push_back(instant);
  if (waiting_.size() < num_to_wait_) return;
  const BodyLevel newest = levelSince(waiting_.size() - level_window_);
  if (newest.is_steady) return turnUpright(newest);
  num_to_wait_ += level_window_ / 2;
  if (num_to_wait_ > kVehicleTuning.most_windows * level_window_) turnUpright(levelSince(0));
}

BodyLevel VehicleGrid::levelSince(std::size_t first) const {
  std::vector<Eigen::Vector3d> accelerations;
  for (std::size_t i = first; i < waiting_.size(); ++i)
    accelerations.emplace_back(Eigen::Map<const Eigen::Vector3d>(&waiting_[i].values[*vehicle_.body_imu]));
  return BodyLevel(accelerations);
}

void VehicleGrid::turnUpright(const BodyLevel& level) {
  level_ = level;
  vehicle_.body_mount = level_.mount;
  for (VehicleChannels::Strut& strut : vehicle_.struts)
    if (strut.position) strut.position = Eigen::Vector3d(level_.mount * *strut.position);
  tops_ = StrutTops(period_, vehicle_);
  num_to_wait_ = 0;
  const std::vector<VehicleReading> readings = std::exchange(waiting_readings_, {});
  auto reading = readings.begin();
  for (const GridInstant& instant : std::exchange(waiting_, {})) {
    for (; reading != readings.end() && reading->stamp <= instant.stamp; ++reading) give(*reading);
    lead(instant);
  }
  for (; reading != readings.end(); ++reading) give(*reading);
}

void VehicleGrid::lead(const GridInstant& instant) {
  if (const VehicleSample* sample = tops_.push(instant)) sink_(*sample);
}

void VehicleGrid::describe(VehicleDrive& drive) const {
  // Of three axes of the body's IMU.
  const auto power = [&](std::size_t first_axis) {
    double squares = 0.0;
    for (std::size_t axis = first_axis; axis < first_axis + 3; ++axis)
      squares += square(body_levels_[axis].deviation());
    return squares;
  };
  const bool is_heard =
      !body_levels_.empty() && body_levels_.front().count() >= kVehicleTuning.fewest_of_noise && power(0) > 0.0;
  const double gyro_noise = is_heard ? std::sqrt(power(3) / power(0)) : kVehicleTuning.gyro_noise_ratio;
  drive.noise = noiseOfStrutTops(vehicle_, period_, gyro_noise);
  for (Drive& strut : drive.struts) strut.low_pass.taps = tops_.lowPass();
}

RejectCounts VehicleGrid::rejected(std::size_t sensor) const {
  RejectCounts all;
  for (std::size_t i = 0; i < sensors_[sensor].count; ++i) all += grid_.rejected(sensors_[sensor].stream + i);
  return all;
}

std::uint64_t VehicleGrid::missed(std::size_t sensor) const {
  std::uint64_t most = 0;
  for (std::size_t i = 0; i < sensors_[sensor].count; ++i)
    most = std::max(most, grid_.missed(sensors_[sensor].stream + i));
  return most;
}

}  // namespace suspension_health_monitor
