#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suspension_health_monitor {

DriveSimulator::DriveSimulator(const SimulationOptions& options)
    : options_(validated(options)),
      sprung_{
          {options, Accelerometer::Place::kSprung}, {options.seed, RandomPurpose::kSprungTiming}, options.rate, 0.0},
      unsprung_{{options, Accelerometer::Place::kUnsprung},
                {options.seed, RandomPurpose::kUnsprungTiming},
                options.unsprung_rate.value_or(options.rate),
                options.unsprung_phase},
      road_(options, Accelerometer::Place::kRoad),
      sway_(swayOf(options)),
      sway_random_(options.seed, RandomPurpose::kSwayNoise),
      faults_(SimulatedFaults::from(options.hidden_faults)),
      now_(quarterCarOf(options), {roadOf(options)}, 1.0 / fasterRate(options)),
      delayed_(now_) {
  scheduleNext(sprung_);
  scheduleNext(unsprung_);
}

std::optional<DriveSample> DriveSimulator::next() {
  const double t = std::min(sprung_.next, unsprung_.next);
  if (std::isinf(t)) return std::nullopt;
  now_.advance(t);

  DriveSample sample;
  sample.stamp = fromSeconds(t);
  sample.truth = now_.truth().struts.front();
  if (sprung_.next == t) {
    const Sway sway = sway_(t);
    sample.sprung = sprung_.accelerometer.read(t, readBody(t, sway));
    sample.body = withNoise(sway);
    scheduleNext(sprung_);
  }
  if (unsprung_.next == t) {
    sample.unsprung = unsprung_.accelerometer.read(t, sample.truth.unsprung_acceleration);
    sample.road = road_.read(t, sample.truth.road_acceleration);
    scheduleNext(unsprung_);
  }
  if (losesReadings(options_, t)) {
    if (sample.sprung) sample.sprung->acceleration = 0.0;
    if (sample.unsprung) sample.unsprung->acceleration = 0.0;
    if (sample.road) sample.road->acceleration = 0.0;
    sample.body = {};
  }
  return sample;
}

void DriveSimulator::scheduleNext(ScheduledSensor& sensor) const {
  const std::optional<double> next = instantOf(++sensor.index, sensor.rate, sensor.phase, options_.duration);
  sensor.next = next.value_or(std::numeric_limits<double>::infinity());
  // Without jitter no number is drawn.
  if (next && options_.sampling_jitter > 0.0) sensor.next += options_.sampling_jitter * sensor.timing.uniform();
}

Sway DriveSimulator::withNoise(Sway sway) {
  const auto add = [this](std::array<double, 2>& values, double rms, double noise) {
    if (rms == 0.0 || noise == 0.0) return;  // no number is drawn, so that other settings keep theirs
    for (double& value : values) value += noise * sway_random_.gaussian();
  };
  add(sway.acceleration, options_.body_acceleration, options_.noise);
  add(sway.angular_rate, options_.body_rate, options_.gyro_noise);
  return sway;
}

double DriveSimulator::readBody(double t, const Sway& sway) {
  VehicleMotion& seen = faults_.delay == 0.0 ? now_ : delayed_;
  seen.advance(t - faults_.delay);  // nothing was before the drive
  return faults_.read(seen.truth().struts.front().sprung_acceleration, sway);
}

}  // namespace suspension_health_monitor
