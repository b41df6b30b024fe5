#include "suspension_health_monitor/internal/simulation/vehicle_motion.h"

#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"

namespace suspension_health_monitor {
namespace {

constexpr double kTolerance = 1e-10;  // per step of an integration, absolute [m, m/s] and relative
constexpr double kFar = 1e4;          // [m], [m/s]: what goes beyond runs away

// Evaluations of the equations, all together and for each longest step, after which an integration comes to no end: a
// tenth of a second's work, and steps that are thousands of times as small.
constexpr double kGrace = 1e6, kMostPerStep = 1e4;

constexpr std::size_t kBodyRates = 3;  // places in the state
constexpr std::size_t kWheels = 6;

std::vector<ActiveEffect> hiddenIn(const Vehicle& vehicle) {
  std::vector<ActiveEffect> all;
  for (const VehicleStrut& strut : vehicle.struts) all.insert(all.end(), strut.hidden.begin(), strut.hidden.end());
  return all;
}

/// How high the top of a strut is, or how fast it rises, per unit of heave, pitch and roll.
Eigen::RowVector3d liftAt(double x, double y) { return {1.0, -x, y}; }
Eigen::RowVector3d liftAt(const VehicleStrut& strut) { return liftAt(strut.x, strut.y); }

double longestStep(const Vehicle& vehicle) {
  double fastest = 0.0;  // square of an angular frequency: the body on its struts, a wheel between strut and tyre
  for (const VehicleStrut& strut : vehicle.struts) {
    const double mobility = vehicle.mobility(strut, strut);
    const double stiffness = strut.stiffness + strut.stop_stiffness_to_mass / mobility;
    const double of_wheel = strut.isRigid() ? 0.0 : (stiffness + strut.tyre_stiffness) / strut.wheel_mass;
    fastest = std::max(fastest, stiffness * mobility + of_wheel);
  }
  return 0.1 / std::sqrt(fastest);
}

VehicleMotion::State restOn(const Vehicle& vehicle, std::vector<Road>& roads) {
  const std::size_t n = vehicle.struts.size();
  VehicleMotion::State state(kWheels + 2 * n + 2 * hiddenIn(vehicle).size(), 0.0);
  Eigen::MatrixXd lift(n, 3);
  Eigen::MatrixX2d wheels(n, 2);
  for (std::size_t i = 0; i < n; ++i) {
    const RoadPoint road = roads.at(i)(0.0);
    lift.row(i) = liftAt(vehicle.struts[i]);
    wheels.row(i) << road.height, road.rate;
    state[kWheels + i] = road.height;
    state[kWheels + n + i] = road.rate;
  }
  const Eigen::MatrixXd plane = pseudoInverse(lift) * wheels;
  Eigen::Map<Eigen::MatrixXd>(state.data(), 3, 2) = plane;  // heights, then rates
  return state;
}

}  // namespace

VehicleMotion::VehicleMotion(const Vehicle& vehicle, std::vector<Road> roads, double between_samples,
                             std::vector<Signal> known_forces)
    : vehicle_(validated(vehicle)),
      roads_(std::move(roads)),
      known_forces_(std::move(known_forces)),
      inverse_inertia_(1.0 / vehicle.mass, vehicle.pitches() ? 1.0 / vehicle.pitch_inertia : 0.0,
                       vehicle.rolls() ? 1.0 / vehicle.roll_inertia : 0.0),
      longest_step_(longestStep(vehicle)),
      sampled_step_(std::min(longest_step_, between_samples)) {
  for (const VehicleStrut& strut : vehicle_.struts) own_mobility_.push_back(vehicle_.mobility(strut, strut));
  truth_.struts.resize(vehicle_.struts.size());
  ground_.resize(vehicle_.struts.size());
  truth_.forces.resize(vehicle_.struts.size());
  truth_.known_forces.resize(vehicle_.known_forces.size());
  state_ = restOn(vehicle_, roads_);
  derivative_.resize(state_.size());
}

void VehicleMotion::advance(double t) {
  namespace odeint = boost::numeric::odeint;
  if (!(t > time_)) return;
  const auto stepper =
      odeint::make_controlled(kTolerance, kTolerance, longest_step_, odeint::runge_kutta_dopri5<State>());
  const auto system = [this](const State& state, State& derivative, double now) {
    if (static_cast<double>(++evaluations_) > kGrace + kMostPerStep * now / sampled_step_)
      giveUp("too stiff to be simulated: its force changes so abruptly that the integration would hardly get on", now);
    evaluate(state, now, derivative);
  };
  const auto check = [this](const State& state, double now) {
    for (std::size_t i = 0; i < kWheels + 2 * vehicle_.struts.size(); ++i)
      if (!(std::abs(state[i]) < kFar)) giveUp("unstable: it runs away", now);
  };
  odeint::integrate_adaptive(stepper, system, state_, time_, t, std::min(longest_step_, t - time_), check);
  time_ = t;
}

void VehicleMotion::giveUp(const char* why, double t) const {
  std::string text = "the strut";
  const char* before = " with ";
  for (const ActiveEffect& active : hiddenIn(vehicle_)) {
    text += before + active.effect.name + formatted(" = %g", active.coefficient);
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      text += ", " + active.effect.shapes[i].name + formatted(" = %g", active.shapes[i]);
    before = "; ";
  }
  throw std::invalid_argument(text + " is " + why + formatted(" (%g s after the start of the drive)", t));
}

const VehicleTruth& VehicleMotion::truth() {
  evaluate(state_, time_, derivative_);
  return truth_;
}

void VehicleMotion::evaluate(const State& state, double t, State& derivative) {
  truth_.body = Eigen::Vector3d(state.data());
  truth_.body_rate = Eigen::Vector3d(state.data() + kBodyRates);
  findForces(state, t);
  accelerateBody(t);
  Eigen::Map<Eigen::Vector3d>(derivative.data()) = truth_.body_rate;
  Eigen::Map<Eigen::Vector3d>(derivative.data() + kBodyRates) = truth_.body_acceleration;
  accelerateWheels(state, t, derivative);
}

void VehicleMotion::findForces(const State& state, double t) {
  const std::size_t n = vehicle_.struts.size();
  const double* memory = state.data() + kWheels + 2 * n;
  for (std::size_t i = 0; i < n; ++i) {
    const VehicleStrut& strut = vehicle_.struts[i];
    DriveTruth& truth = truth_.struts[i];
    const RoadPoint& road = ground_[i] = roads_[i](t);
    truth.road_height = road.height;
    truth.road_acceleration = road.acceleration;
    const bool is_rigid = strut.isRigid();
    truth.travel = (is_rigid ? road.height : state[kWheels + i]) - liftAt(strut) * truth_.body;
    truth.travel_rate = (is_rigid ? road.rate : state[kWheels + n + i]) - liftAt(strut) * truth_.body_rate;
    truth.damping_to_mass = own_mobility_[i] * strut.damping * strut.shareAt(t, strut.damping_end_fraction);
    truth.stiffness_to_mass = own_mobility_[i] * strut.stiffness * strut.shareAt(t, strut.stiffness_end_fraction);
    double per_mass = truth.damping_to_mass * truth.travel_rate + truth.stiffness_to_mass * truth.travel;
    if (strut.stop_stiffness_to_mass > 0.0) per_mass += strut.stopForceToMass(truth.travel);
    for (const ActiveEffect& active : strut.hidden) {
      per_mass += active.force({truth.travel, truth.travel_rate, t, {memory[0], memory[1]}});
      memory += 2;
    }
    truth_.forces[i] = per_mass / own_mobility_[i];
  }
  for (const AntiRollBar& bar : vehicle_.anti_roll_bars) {
    const double force = bar.stiffness * (truth_.struts[bar.first].travel - truth_.struts[bar.second].travel);
    truth_.forces[bar.first] += force;
    truth_.forces[bar.second] -= force;
  }
}

// Heave takes the sum of the forces, pitch -sum x F, roll sum y F: the same three numbers as of the lift.
void VehicleMotion::accelerateBody(double t) {
  Eigen::Vector3d load = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < vehicle_.struts.size(); ++i)
    load += truth_.forces[i] * liftAt(vehicle_.struts[i]).transpose();
  for (std::size_t k = 0; k < known_forces_.size(); ++k) {
    truth_.known_forces[k] = known_forces_[k](t);
    load += truth_.known_forces[k] * liftAt(vehicle_.known_forces[k].x, vehicle_.known_forces[k].y).transpose();
  }
  truth_.body_acceleration = inverse_inertia_.cwiseProduct(load);
}

void VehicleMotion::accelerateWheels(const State& state, double t, State& derivative) {
  const std::size_t n = vehicle_.struts.size();
  std::size_t memory = kWheels + 2 * n;
  for (std::size_t i = 0; i < n; ++i) {
    const VehicleStrut& strut = vehicle_.struts[i];
    DriveTruth& truth = truth_.struts[i];
    truth.sprung_acceleration = liftAt(strut) * truth_.body_acceleration;
    const double height = state[kWheels + i], rate = state[kWheels + n + i];
    const RoadPoint& road = ground_[i];
    const double tyre = strut.tyre_stiffness * (road.height - height) + strut.tyre_damping * (road.rate - rate);
    truth.unsprung_acceleration = strut.isRigid() ? road.acceleration : (tyre - truth_.forces[i]) / strut.wheel_mass;
    derivative[kWheels + i] = strut.isRigid() ? 0.0 : rate;
    derivative[kWheels + n + i] = strut.isRigid() ? 0.0 : truth.unsprung_acceleration;
    for (const ActiveEffect& active : strut.hidden) {
      const Memory now(state[memory], state[memory + 1]);
      const Memory change = active.memoryRate({truth.travel, truth.travel_rate, t, now, truth.sprung_acceleration});
      derivative[memory++] = change.s;
      derivative[memory++] = change.second;
    }
  }
}

}  // namespace suspension_health_monitor
