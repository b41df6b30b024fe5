#include "suspension_health_monitor/internal/simulation/sensors.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {

constexpr int kNumSines = 24;

// By place.
constexpr std::array kNoise{RandomPurpose::kSprungNoise, RandomPurpose::kUnsprungNoise, RandomPurpose::kRoadNoise};
constexpr std::array kDelivery{RandomPurpose::kSprungDelivery, RandomPurpose::kUnsprungDelivery,
                               RandomPurpose::kRoadDelivery};

std::function<Sway(double t)> swayOf(const SimulationOptions& options) {
  struct Sine {
    double amplitude, frequency, phase;  // frequency [rad/s]
  };
  using Sines = std::vector<Sine>;
  RandomStream random(options.seed, RandomPurpose::kSway);
  const auto draw = [&](double rms, double lowest, double highest) {
    Sines sines;
    for (int i = 0; i < kNumSines; ++i) {
      const double share = (i + random.uniform()) / kNumSines;  // spread evenly by ratio
      sines.push_back({rms * std::sqrt(2.0 / kNumSines), 2.0 * M_PI * lowest * std::pow(highest / lowest, share),
                       2.0 * M_PI * random.uniform()});
    }
    return sines;
  };
  std::array<Sines, 2> accelerations, rates;
  for (Sines& sines : accelerations) sines = draw(options.body_acceleration, 0.1, 1.0);
  for (Sines& sines : rates) sines = draw(options.body_rate, 0.3, 4.0);
  return [accelerations, rates](double t) {
    Sway sway;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (const Sine& s : accelerations[axis])
        sway.acceleration[axis] += s.amplitude * std::sin(s.frequency * t + s.phase);
      for (const Sine& s : rates[axis]) {
        sway.angular_rate[axis] += s.amplitude * std::sin(s.frequency * t + s.phase);
        sway.angular_acceleration[axis] += s.amplitude * s.frequency * std::cos(s.frequency * t + s.phase);
      }
    }
    return sway;
  };
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
  // A uniform variable of half-width h has the standard deviation h / sqrt(3).
  const double noise =
      gaussian_ ? noise_ * noise_random_.gaussian() : noise_ * std::sqrt(3.0) * (2.0 * noise_random_.uniform() - 1.0);
  const bool lost = delivery_random_.uniform() < dropout_;
  const double delay = stamp_jitter_ * delivery_random_.uniform();
  if (lost) return std::nullopt;
  return AccelerometerReading{fromSeconds(clock_offset_ + clock_rate_ * t + delay), acceleration + noise};
}

SimulatedFaults SimulatedFaults::from(const std::vector<ActiveMeasurementEffect>& hidden) {
  SimulatedFaults faults;
  const std::map<std::string, std::vector<double*>> known{{"accelerometer_bias", {&faults.bias}},
                                                          {"clock_offset", {&faults.delay}},
                                                          {"lever_arm", {&faults.position[0], &faults.position[1]}},
                                                          {"mount_tilt", {&faults.tilt[0], &faults.tilt[1]}},
                                                          {"scale_error", {&faults.gain_error}}};
  for (const auto& [effect, sizes] : hidden) {
    const auto found = known.find(effect.name);
    if (found == known.end())
      throw std::invalid_argument("hidden fault " + effect.name +
                                  ", must be one of clock_offset, accelerometer_bias, " +
                                  "scale_error, mount_tilt, lever_arm");
    for (std::size_t i = 0; i < found->second.size(); ++i) *found->second[i] = sizes.at(i);
  }
  return faults;
}

double SimulatedFaults::readAtRest(double gravity) const {
  return (1.0 + gain_error) * std::cos(std::hypot(tilt[0], tilt[1])) * gravity;
}

double SimulatedFaults::read(double acceleration, const Sway& sway) const {
  // Away from the strut's top a turning body moves up by (angular acceleration) x (position), z component.
  const double here =
      acceleration + sway.angular_acceleration[0] * position[1] - sway.angular_acceleration[1] * position[0];
  return (1.0 + gain_error) * (here + tilt[0] * sway.acceleration[0] + tilt[1] * sway.acceleration[1]) + bias;
}

RandomStream::RandomStream(int seed, RandomPurpose purpose, unsigned index) {
  std::vector<unsigned> numbers{static_cast<unsigned>(seed), static_cast<unsigned>(purpose)};
  if (index != 0) numbers.push_back(index);
  std::seed_seq sequence(numbers.begin(), numbers.end());
  engine_.seed(sequence);
}

double RandomStream::uniform() {
  // The upper 53 bits fill a double's mantissa exactly.
  return static_cast<double>(engine_() >> 11) * 0x1p-53;
}

double RandomStream::gaussian() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * M_PI * uniform());
}

}  // namespace suspension_health_monitor
