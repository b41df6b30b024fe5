#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>

namespace suspension_health_monitor {
namespace {

double longestStep(const Scenario& scenario) {
  const QuarterCar& car = scenario.vehicle;
  double strut = scenario.strut.stiffness_to_mass;
  if (scenario.strut.end_stops) strut += scenario.strut.end_stops->stiffness_to_mass;
  // Squares of angular frequencies: the body on its strut, the wheel between strut and tyre.
  double fastest = strut;
  if (car.tyre_stiffness) fastest += (strut * car.sprung_mass + *car.tyre_stiffness) / car.unsprung_mass;
  return 0.1 / std::sqrt(fastest);
}

}  // namespace

DriveSimulator::DriveSimulator(const SimulationOptions& options)
    : scenario_(makeScenario(options)),
      sprung_{{options, Accelerometer::Place::kSprung}, {options.rate, 0.0, options, RandomPurpose::kSprungTiming}},
      unsprung_{{options, Accelerometer::Place::kUnsprung},
                {options.unsprung_rate.value_or(options.rate), options.unsprung_phase, options,
                 RandomPurpose::kUnsprungTiming}},
      road_(options, Accelerometer::Place::kRoad),
      sway_(options),
      sway_sensor_(options),
      faults_(SensorFaults::from(options.hidden_faults)),
      max_step_(longestStep(scenario_)),
      guard_(options.hidden, std::min(max_step_, 1.0 / fasterRate(options))) {
  const RoadPoint start = scenario_.road(0.0);
  now_.state = {start.height, start.rate, start.height, start.rate};
  delayed_ = now_;
}

std::optional<DriveSample> DriveSimulator::next() {
  const std::optional<double> body_time = sprung_.schedule.next(), wheel_time = unsprung_.schedule.next();
  if (!body_time && !wheel_time) return std::nullopt;
  const bool body_reads = body_time && (!wheel_time || *body_time <= *wheel_time);
  const bool wheel_reads = wheel_time && (!body_time || *wheel_time <= *body_time);
  const double t = body_reads ? *body_time : *wheel_time;
  integrate(now_, t);

  DriveSample sample;
  sample.stamp = fromSeconds(t);
  sample.truth = motionAt(now_).truth;
  if (body_reads) {
    const Sway sway = sway_.at(t);
    sample.sprung = sprung_.accelerometer.read(t, readBody(sway));
    sample.body = sway_sensor_.read(sway);
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

DriveSimulator::Motion DriveSimulator::motionAt(const State& state, double t) {
  const RoadPoint road = scenario_.road(t);
  const QuarterCar& car = scenario_.vehicle;
  const bool rigid = !car.tyre_stiffness;
  const double z = state[0], z_rate = state[1], w_state = state[2], w_rate_state = state[3];
  std::array<Memory, kMostHiddenEffects> memory;
  for (std::size_t j = 0; j < memory.size(); ++j) memory[j] = {state[4 + 2 * j], state[5 + 2 * j]};
  const double w = rigid ? road.height : w_state;
  const double w_rate = rigid ? road.rate : w_rate_state;

  Motion motion{};
  DriveTruth& truth = motion.truth;
  truth.damping_to_mass = scenario_.strut.damping_to_mass.at(t);
  truth.stiffness_to_mass = scenario_.strut.stiffness_to_mass;
  truth.travel = w - z;
  truth.travel_rate = w_rate - z_rate;
  truth.road_height = road.height;
  truth.road_acceleration = road.acceleration;
  truth.sprung_acceleration = scenario_.strut.forcePerMass(truth.travel, truth.travel_rate, t, memory.data());
  if (rigid) {
    truth.unsprung_acceleration = road.acceleration;
    motion.derivative = {z_rate, truth.sprung_acceleration, 0.0, 0.0};
  } else {
    const double strut_force = car.sprung_mass * truth.sprung_acceleration;
    truth.unsprung_acceleration = -(strut_force + *car.tyre_stiffness * (w - road.height)) / car.unsprung_mass;
    motion.derivative = {z_rate, truth.sprung_acceleration, w_rate, truth.unsprung_acceleration};
  }
  for (std::size_t j = 0; j < scenario_.strut.hidden.size(); ++j) {
    const Memory rate =
        scenario_.strut.memoryRate(j, {truth.travel, truth.travel_rate, t, memory[j], truth.sprung_acceleration});
    motion.derivative[4 + 2 * j] = rate.s;
    motion.derivative[5 + 2 * j] = rate.second;
  }
  return motion;
}

double DriveSimulator::readBody(const Sway& sway) {
  if (faults_.delay == 0.0) return faults_.read(motionAt(now_).truth.sprung_acceleration, sway);
  integrate(delayed_, std::max(0.0, now_.time - faults_.delay));  // nothing was before the drive
  return faults_.read(motionAt(delayed_).truth.sprung_acceleration, sway);
}

void DriveSimulator::integrate(Course& course, double to) {
  if (to <= course.time) return;
  namespace odeint = boost::numeric::odeint;
  const double first_step = std::min(max_step_, to - course.time);
  const auto stepper = odeint::make_controlled(IntegrationGuard::kTolerance, IntegrationGuard::kTolerance, max_step_,
                                               odeint::runge_kutta_dopri5<State>());
  const auto system = [this](const State& x, State& derivative, double t) {
    guard_.countEvaluation(t);
    derivative = motionAt(x, t).derivative;
  };
  const auto check = [this](const State& x, double t) {
    guard_.checkMotion(x[0], x[1], t);
    guard_.checkMotion(x[2], x[3], t);
  };
  odeint::integrate_adaptive(stepper, system, course.state, course.time, to, first_step, check);
  course.time = to;
}

}  // namespace suspension_health_monitor
