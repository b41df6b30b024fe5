#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/signal/continuity.h"
#include "suspension_health_monitor/internal/statistics.h"
#include "suspension_health_monitor/internal/vehicle/sensor_noise.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLevelSeconds = 10.0;       // longer than most braking, pulling away and bends
constexpr std::size_t kMostWindows = 3;      // of so many seconds: those take less than half of them
constexpr double kLevelMemory = 4096.0;      // samples: the ratio of two deviations within 2 %
constexpr std::size_t kFewestOfLevel = 256;  // the same within 5 %

}  // namespace

VehicleGrid::VehicleGrid(double period, const VehicleStreams& streams, const GridOptions& options, Sink sink)
    : period_(fromSeconds(period)),
      vehicle_(streams.channels),
      tops_(period_, streams.channels),
      grid_(period, streams.options, options.alignment, options.fill_samples + 2 * tops_.delay()),
      body_levels_(streams.channels.body_imu ? 6 : 0, WhiteLevel(1.0 - 1.0 / kLevelMemory)),
      sink_(std::move(sink)) {
  for (const VehicleStreams::Sensor& sensor : streams.sensors) {
    std::size_t end = sensor.stream;
    while (end < streams.options.size() && streams.options[end].sensor == streams.options[sensor.stream].sensor) ++end;
    channels_.push_back({sensor.stream, end});
  }
  // Gaps cost a level some instants.
  if (vehicle_.body_imu)
    level_window_ = std::max(static_cast<std::size_t>(std::ceil(kLevelSeconds / period)), 2 * kFewestOfLevel);
  num_to_wait_ = level_window_;
  waiting_.reserve(kMostWindows * level_window_);
}

void VehicleGrid::push(std::size_t sensor, Stamp stamp, const std::vector<double>& values) {
  std::size_t stream = channels_[sensor].first;
  for (const double value : values)
    for (auto instant = grid_.push(stream++, stamp, value); instant != nullptr; instant = grid_.next()) take(*instant);
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
  if (newest.isSteady()) return turnUpright(newest);
  num_to_wait_ += level_window_ / 2;
  if (num_to_wait_ > kMostWindows * level_window_) turnUpright(levelSince(0));
}

void VehicleGrid::finish() {
  if (!waiting_.empty()) turnUpright(levelSince(0));
}

BodyLevel VehicleGrid::levelSince(std::size_t first) const {
  std::vector<Eigen::Vector3d> accelerations;
  for (std::size_t i = first; i < waiting_.size(); ++i)
    accelerations.emplace_back(Eigen::Map<const Eigen::Vector3d>(&waiting_[i].values[*vehicle_.body_imu]));
  return BodyLevel(accelerations);
}

void VehicleGrid::turnUpright(const BodyLevel& level) {
  level_ = level;
  vehicle_.body_mount = level_.mount();
  for (VehicleChannels::Strut& strut : vehicle_.struts) strut.position = level_.mount() * strut.position;
  tops_ = StrutTops(period_, vehicle_);
  num_to_wait_ = 0;
  for (const GridInstant& instant : std::exchange(waiting_, {})) lead(instant);
}

void VehicleGrid::lead(const GridInstant& instant) {
  if (const VehicleSample* sample = tops_.push(instant)) sink_(*sample);
}

// @return of three axes of the body's IMU, rms.
double VehicleGrid::deviation(std::size_t first_axis) const {
  double squares = 0.0;
  for (std::size_t axis = first_axis; axis < first_axis + 3; ++axis) squares += square(body_levels_[axis].deviation());
  return std::sqrt(squares / 3.0);
}

bool VehicleGrid::hasHeardNoise() const {
  return !body_levels_.empty() && body_levels_.front().count() >= kFewestOfLevel && deviation(0) > 0.0;
}

SensorNoise VehicleGrid::noise() const {
  return noiseOfStrutTops(vehicle_, period_, hasHeardNoise() ? deviation(3) / deviation(0) : kUsualGyroNoise);
}

void VehicleGrid::describe(VehicleDrive& drive) const {
  drive.noise = noise();
  for (Drive& strut : drive.struts) strut.low_pass.taps = tops_.lowPass();
}

RejectCounts VehicleGrid::rejected(std::size_t sensor) const {
  RejectCounts all;
  for (std::size_t stream = channels_[sensor].first; stream < channels_[sensor].end; ++stream)
    all += grid_.rejected(stream);
  return all;
}

std::uint64_t VehicleGrid::missed(std::size_t sensor) const {
  std::uint64_t most = 0;
  for (std::size_t stream = channels_[sensor].first; stream < channels_[sensor].end; ++stream)
    most = std::max(most, grid_.missed(stream));
  return most;
}

}  // namespace suspension_health_monitor
