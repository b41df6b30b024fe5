#include "suspension_health_monitor/internal/simulation/vehicle_simulator.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

constexpr int kSinesOfForce = 48;

/// A sum of sines of even density over the band, each with an equal share of the variance.
VehicleMotion::Signal signalOf(const KnownForce& force, int seed, unsigned index) {
  struct Sine {
    double frequency, phase;  // [rad/s], [rad]
  };
  RandomStream random(seed, RandomPurpose::kKnownForce, index);
  std::vector<Sine> sines;
  const double width = (force.highest_frequency - force.lowest_frequency) / kSinesOfForce;
  for (int i = 0; i < kSinesOfForce; ++i) {
    const double frequency = force.lowest_frequency + (i + random.uniform()) * width;
    sines.push_back({2.0 * M_PI * frequency, 2.0 * M_PI * random.uniform()});
  }
  const double amplitude = force.rms * std::sqrt(2.0 / kSinesOfForce);
  return [sines, amplitude](double t) {
    double sum = 0.0;
    for (const Sine& sine : sines) sum += std::sin(sine.frequency * t + sine.phase);
    return amplitude * sum;
  };
}

std::vector<VehicleMotion::Signal> signalsOf(const Vehicle& vehicle, int seed) {
  std::vector<VehicleMotion::Signal> signals;
  for (const KnownForce& force : vehicle.known_forces)
    signals.push_back(signalOf(force, seed, static_cast<unsigned>(signals.size())));
  return signals;
}

// @return 0: left, 1: right, 2: in the middle.
unsigned sideOf(const VehicleStrut& strut) {
  if (strut.y > 0.0) return 0;
  return strut.y < 0.0 ? 1 : 2;
}

// Accelerometers, whose clocks are right.
SimulationOptions sensorsOf(const VehicleDriveOptions& drive) {
  SimulationOptions sensors;
  sensors.duration = drive.duration;
  sensors.seed = drive.seed;
  sensors.noise = drive.noise;
  sensors.gaussian_noise = true;
  sensors.dropout = drive.dropout;
  sensors.stamp_jitter = drive.stamp_jitter;
  return sensors;
}

}  // namespace

void validate(const VehicleDriveOptions& options) {
  validate(options, kVehicleDriveFields);
  if (options.stamp_jitter >= 1.0 / options.rate)
    refuse("stamp_jitter", options.stamp_jitter, "s",
           formatted("less than one sample period, 1 / rate = %g", 1.0 / options.rate));
}

std::vector<Road> tracksOf(const Vehicle& vehicle, const std::string& tracks, int seed) {
  double front = vehicle.struts.front().x;
  for (const VehicleStrut& strut : vehicle.struts) front = std::max(front, strut.x);
  std::vector<Road> roads;
  for (const VehicleStrut& strut : vehicle.struts) {
    const double delay = (front - strut.x) / vehicle.speed, lateral = tracks == "coherent" ? strut.y : 0.0;
    const unsigned surface = tracks == "independent" ? sideOf(strut) : 0;
    IsoRoad road(vehicle.iso_class.front(), vehicle.speed, seed, lateral, surface);
    roads.emplace_back([road, delay](double t) mutable { return road(t - delay); });
  }
  return roads;
}

SixAxisReading readIdeally(const VehicleTruth& truth, const VehicleImu& imu, double gravity) {
  const auto turning = [](const Eigen::Vector3d& body) { return Eigen::Vector3d(body[2], body[1], 0.0); };
  const Eigen::Vector3d tilt = turning(truth.body), rate = turning(truth.body_rate);
  const Eigen::Vector3d angular_acceleration = turning(truth.body_acceleration), place = imu.position();
  // The world's vertical in the axes of a body that has pitched and rolled.
  const Eigen::Vector3d vertical(-std::sin(tilt[1]), std::sin(tilt[0]) * std::cos(tilt[1]),
                                 std::cos(tilt[0]) * std::cos(tilt[1]));
  const Eigen::Matrix3d to_imu = imu.orientation().transpose();
  SixAxisReading reading;
  reading.acceleration = to_imu * ((truth.body_acceleration[0] + gravity) * vertical +
                                   angular_acceleration.cross(place) + rate.cross(rate.cross(place)));
  reading.angular_rate = to_imu * rate;
  return reading;
}

VehicleSimulator::VehicleSimulator(const Vehicle& vehicle, const VehicleDriveOptions& options)
    : vehicle_(validated(vehicle)),
      options_(validated(options)),
      motion_(vehicle_, tracksOf(vehicle_, options.tracks, options.seed), 1.0 / options.rate,
              signalsOf(vehicle_, options.seed)),
      body_(sensorsOf(options), Accelerometer::Place::kSprung),
      body_noise_(options.seed, RandomPurpose::kSwayNoise),
      gyro_noise_(options.seed, RandomPurpose::kGyroNoise),
      force_noise_(options.seed, RandomPurpose::kKnownForceNoise) {
  const SimulationOptions sensors = sensorsOf(options);
  for (unsigned i = 1; i <= vehicle_.struts.size(); ++i) {
    sprung_.emplace_back(sensors, Accelerometer::Place::kSprung, i);
    unsprung_.emplace_back(sensors, Accelerometer::Place::kUnsprung, i);
  }
}

std::optional<VehicleInstant> VehicleSimulator::next() {
  const std::optional<double> next = instantOf(index_++, options_.rate, 0.0, options_.duration);
  if (!next) return std::nullopt;
  const double t = *next;
  motion_.advance(t);

  VehicleInstant sample;
  sample.stamp = fromSeconds(t);
  sample.truth = motion_.truth();
  for (std::size_t i = 0; i < vehicle_.struts.size(); ++i) {
    const DriveTruth& truth = sample.truth.struts[i];
    const VehicleStrut& strut = vehicle_.struts[i];
    sample.struts.push_back({sprung_[i].read(t, truth.sprung_acceleration + strut.sprung_offset),
                             unsprung_[i].read(t, truth.unsprung_acceleration + strut.unsprung_offset)});
  }
  sample.body = readBody(t);
  for (std::size_t i = 0; i < vehicle_.known_forces.size(); ++i)
    sample.known_forces.push_back(sample.truth.known_forces[i] +
                                  vehicle_.known_forces[i].noise * force_noise_.gaussian());
  return sample;
}

std::optional<SixAxisReading> VehicleSimulator::readBody(double t) {
  const VehicleImu& imu = vehicle_.body_imu;
  SixAxisReading reading = readIdeally(motion_.truth(), imu, options_.gravity);
  for (Eigen::Index axis = 0; axis < 2; ++axis) reading.acceleration[axis] += options_.noise * body_noise_.gaussian();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    reading.angular_rate[axis] += options_.gyro_noise * gyro_noise_.gaussian();
  reading.acceleration += Eigen::Vector3d(imu.offset_x, imu.offset_y, imu.offset_z);
  reading.angular_rate += Eigen::Vector3d(imu.gyro_offset_x, imu.gyro_offset_y, imu.gyro_offset_z);
  // The accelerometer on z tells whether and when the message of all axes arrives.
  const std::optional<AccelerometerReading> vertical = body_.read(t, reading.acceleration.z());
  if (!vertical) return std::nullopt;
  reading.stamp = vertical->stamp;
  reading.acceleration.z() = vertical->acceleration;
  return reading;
}

}  // namespace suspension_health_monitor
