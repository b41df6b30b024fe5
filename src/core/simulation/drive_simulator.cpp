#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {

DriveSimulator::DriveSimulator(const SimulationOptions& options)
    : scenario_(makeScenario(options)),
      sprung_{{options, Accelerometer::Place::kSprung}, {options.rate, 0.0, options, RandomPurpose::kSprungTiming}},
      unsprung_{{options, Accelerometer::Place::kUnsprung},
                {options.unsprung_rate.value_or(options.rate), options.unsprung_phase, options,
                 RandomPurpose::kUnsprungTiming}},
      road_(options, Accelerometer::Place::kRoad),
      sway_(options),
      sway_noise_{options.body_acceleration > 0.0 ? options.noise : 0.0,
                  options.body_rate > 0.0 ? options.gyro_noise : 0.0},
      sway_random_(options.seed, RandomPurpose::kSwayNoise),
      faults_(SimulatedFaults::from(options.hidden_faults)),
      now_(scenario_.driven, {scenario_.road}, 1.0 / fasterRate(options)),
      delayed_(now_) {}

std::optional<DriveSample> DriveSimulator::next() {
  const std::optional<double> body_time = sprung_.schedule.next(), wheel_time = unsprung_.schedule.next();
  if (!body_time && !wheel_time) return std::nullopt;
  const bool body_reads = body_time && (!wheel_time || *body_time <= *wheel_time);
  const bool wheel_reads = wheel_time && (!body_time || *wheel_time <= *body_time);
  const double t = body_reads ? *body_time : *wheel_time;
  now_.advance(t);

  DriveSample sample;
  sample.stamp = fromSeconds(t);
  sample.truth = now_.truth().struts.front();
  if (body_reads) {
    const Sway sway = sway_.at(t);
    sample.sprung = sprung_.accelerometer.read(t, readBody(t, sway));
    sample.body = withNoise(sway);
    sprung_.schedule.advance();
  }
  if (wheel_reads) {
    sample.unsprung = unsprung_.accelerometer.read(t, sample.truth.unsprung_acceleration);
    sample.road = road_.read(t, sample.truth.road_acceleration);
    unsprung_.schedule.advance();
  }
  for (const TimeWindow& window : scenario_.zero_readings) {
    if (!window.contains(t)) continue;
    if (sample.sprung) sample.sprung->acceleration = 0.0;
    if (sample.unsprung) sample.unsprung->acceleration = 0.0;
    if (sample.road) sample.road->acceleration = 0.0;
    sample.body = {};
  }
  return sample;
}

Sway DriveSimulator::withNoise(Sway sway) {
  const auto add = [this](std::array<double, 2>& values, double noise) {
    if (noise == 0.0) return;  // no number is drawn, so that other settings keep theirs
    for (double& value : values) value += noise * sway_random_.gaussian();
  };
  add(sway.acceleration, sway_noise_[0]);
  add(sway.angular_rate, sway_noise_[1]);
  return sway;
}

double DriveSimulator::readBody(double t, const Sway& sway) {
  VehicleMotion& seen = faults_.delay == 0.0 ? now_ : delayed_;
  seen.advance(t - faults_.delay);  // nothing was before the drive
  return faults_.read(seen.truth().struts.front().sprung_acceleration, sway);
}

}  // namespace suspension_health_monitor
