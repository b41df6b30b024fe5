#include "suspension_health_monitor/internal/simulation/sensors.h"

#include <cmath>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

// By place.
constexpr std::array kNoise{RandomPurpose::kSprungNoise, RandomPurpose::kUnsprungNoise, RandomPurpose::kRoadNoise};
constexpr std::array kDelivery{RandomPurpose::kSprungDelivery, RandomPurpose::kUnsprungDelivery,
                               RandomPurpose::kRoadDelivery};

}  // namespace

SensorSchedule::SensorSchedule(double rate, double phase, const SimulationOptions& options, RandomPurpose timing)
    : rate_(rate),
      phase_(phase),
      jitter_(options.sampling_jitter),
      duration_(options.duration),
      random_(options.seed, timing) {
  advance();
}

void SensorSchedule::advance() {
  const auto k = static_cast<double>(++index_);
  // A duration that is a whole number of periods must not lose its last sample to rounding.
  next_.reset();
  if (k <= (duration_ - phase_) * rate_ + 1e-6) next_ = phase_ + k / rate_;
  if (next_ && jitter_ > 0.0) *next_ += jitter_ * random_.uniform();
}

Accelerometer::Accelerometer(const SimulationOptions& options, Place place, unsigned index)
    : noise_random_(options.seed, kNoise[static_cast<std::size_t>(place)], index),
      delivery_random_(options.seed, kDelivery[static_cast<std::size_t>(place)], index),
      noise_(options.noise),
      gaussian_(options.gaussian_noise),
      dropout_(options.dropout),
      stamp_jitter_(options.stamp_jitter),
      clock_offset_(place == Place::kSprung ? options.clock_offset : 0.0),
      clock_rate_(place == Place::kSprung ? 1.0 + options.clock_skew : 1.0) {}

std::optional<AccelerometerReading> Accelerometer::read(double t, double acceleration) {
  const double measured = acceleration + drawNoise();
  const bool lost = delivery_random_.uniform() < dropout_;
  const double delay = stamp_jitter_ * delivery_random_.uniform();
  if (lost) return std::nullopt;
  return AccelerometerReading{fromSeconds(clock_offset_ + clock_rate_ * t + delay), measured};
}

double Accelerometer::drawNoise() {
  // A uniform variable of half-width h has the standard deviation h / sqrt(3).
  if (gaussian_) return noise_ * noise_random_.gaussian();
  return noise_ * std::sqrt(3.0) * (2.0 * noise_random_.uniform() - 1.0);
}

SwaySensor::SwaySensor(const SimulationOptions& options)
    : acceleration_noise_(options.body_acceleration > 0.0 ? options.noise : 0.0),
      rate_noise_(options.body_rate > 0.0 ? options.gyro_noise : 0.0),
      random_(options.seed, RandomPurpose::kSwayNoise) {}

Sway SwaySensor::read(Sway sway) {
  const auto add = [this](std::array<double, 2>& values, double noise) {
    if (noise == 0.0) return;  // no number is drawn, so that other settings keep theirs
    for (double& value : values) value += noise * random_.gaussian();
  };
  add(sway.acceleration, acceleration_noise_);
  add(sway.angular_rate, rate_noise_);
  return sway;
}

SensorFaults SensorFaults::from(const std::vector<ActiveMeasurementEffect>& hidden) {
  SensorFaults faults;
  for (const ActiveMeasurementEffect& active : hidden) {
    const std::string& name = active.effect.name;
    const std::vector<double>& sizes = active.coefficients;
    if (name == "clock_offset")
      faults.delay = sizes.at(0);
    else if (name == "accelerometer_bias")
      faults.bias = sizes.at(0);
    else if (name == "scale_error")
      faults.gain_error = sizes.at(0);
    else if (name == "mount_tilt")
      faults.tilt = {sizes.at(0), sizes.at(1)};
    else if (name == "lever_arm")
      faults.position = {sizes.at(0), sizes.at(1)};
    else
      throw std::invalid_argument("hidden fault " + name + ", must be one of clock_offset, accelerometer_bias, " +
                                  "scale_error, mount_tilt, lever_arm");
  }
  return faults;
}

double SensorFaults::readAtRest(double gravity) const {
  return (1.0 + gain_error) * std::cos(std::hypot(tilt[0], tilt[1])) * gravity;
}

double SensorFaults::read(double acceleration, const Sway& sway) const {
  // Away from the strut's top a turning body moves up by (angular acceleration) x (position), z component.
  const double here =
      acceleration + sway.angular_acceleration[0] * position[1] - sway.angular_acceleration[1] * position[0];
  return (1.0 + gain_error) * (here + tilt[0] * sway.acceleration[0] + tilt[1] * sway.acceleration[1]) + bias;
}

}  // namespace suspension_health_monitor
