#include "suspension_health_monitor/model/free_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

constexpr double kLongestStep = 0.35;  // in units of the model's fastest time; keeps the step error below 1e-4
constexpr double kMostSteps = 31.0;

bool isFewEnough(double steps) { return steps > 0.0 && steps <= kMostSteps; }  // not NaN

}  // namespace

FreeRun::FreeRun(double period) : period_(period) {
  if (!(std::isfinite(period) && period > 0.0))
    throw std::invalid_argument("sample_period = " + std::to_string(period) + " [s], must be above 0");
}

// How many steps of kLongestStep a sample has; not above 0 or NaN unless both parameters are above 0.
double FreeRun::exactSteps(double damping_to_mass, double stiffness_to_mass) const {
  if (!(damping_to_mass > 0.0 && stiffness_to_mass > 0.0)) return 0.0;
  return period_ * std::max(damping_to_mass, std::sqrt(stiffness_to_mass)) / kLongestStep;
}

bool FreeRun::accepts(double damping_to_mass, double stiffness_to_mass) const {
  return isFewEnough(exactSteps(damping_to_mass, stiffness_to_mass));
}

bool FreeRun::trySetModel(double damping_to_mass, double stiffness_to_mass) {
  const double steps = exactSteps(damping_to_mass, stiffness_to_mass);
  if (!isFewEnough(steps)) return false;
  if (num_steps_ > 0) state_[0] *= stiffness_to_mass_ / stiffness_to_mass;
  damping_to_mass_ = damping_to_mass;
  stiffness_to_mass_ = stiffness_to_mass;
  num_steps_ = 1 + static_cast<int>(steps);
  // Roots of s^2 + b1 s + b0; an overdamped strut has a slow real one.
  const double half = damping_to_mass / 2;
  const double discriminant = half * half - stiffness_to_mass;
  decay_rate_ = discriminant > 0.0 ? stiffness_to_mass / (half + std::sqrt(discriminant)) : half;
  return true;
}

void FreeRun::setModel(double damping_to_mass, double stiffness_to_mass) {
  if (trySetModel(damping_to_mass, stiffness_to_mass)) return;
  throw std::invalid_argument("damping_to_mass = " + std::to_string(damping_to_mass) +
                              " [1/s], stiffness_to_mass = " + std::to_string(stiffness_to_mass) +
                              " [1/s^2]: both must be above 0 and slow enough for sample_period = " +
                              std::to_string(period_) + " [s]");
}

std::optional<double> FreeRun::push(double unsprung_acceleration) {
  std::copy_backward(input_.begin(), input_.end() - 1, input_.end());
  input_.front() = unsprung_acceleration;
  if (num_inputs_ < kNodes) ++num_inputs_;
  if (num_steps_ == 0 || num_inputs_ < kNodes) return std::nullopt;
  if (decayed_ == 0.0) state_ = {input_[1] / stiffness_to_mass_, 0.0};  // at rest under a constant such as gravity
  advance();
  decayed_ += decay_rate_ * period_;
  return damping_to_mass_ * state_[1] + stiffness_to_mass_ * state_[0];
}

void FreeRun::advance() {
  const double h = period_ / num_steps_;
  const auto moved = [&](double by, const State& slope) {
    return State{state_[0] + by * slope[0], state_[1] + by * slope[1]};
  };
  double at_start = input_[1];
  for (int step = 0; step < num_steps_; ++step) {
    const double at_middle = interpolate((step + 0.5) / num_steps_);
    const double at_end = step + 1 == num_steps_ ? input_[0] : interpolate((step + 1.0) / num_steps_);
    const State k1 = derivative(state_, at_start);
    const State k2 = derivative(moved(h / 2, k1), at_middle);
    const State k3 = derivative(moved(h / 2, k2), at_middle);
    const State k4 = derivative(moved(h, k3), at_end);
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
    at_start = at_end;
  }
}

// Lagrange's cubic through the newest four samples, at `fraction` of the way from the last but one to the newest.
double FreeRun::interpolate(double fraction) const {
  const double s = fraction - 1.0;  // in samples from the newest, -1 < s < 0
  return input_[0] * (s + 1) * (s + 2) * (s + 3) / 6 - input_[1] * s * (s + 2) * (s + 3) / 2 +
         input_[2] * s * (s + 1) * (s + 3) / 2 - input_[3] * s * (s + 1) * (s + 2) / 6;
}

FreeRun::State FreeRun::derivative(const State& state, double unsprung_acceleration) const {
  return {state[1], unsprung_acceleration - damping_to_mass_ * state[1] - stiffness_to_mass_ * state[0]};
}

void FreeRun::reset() {
  state_ = {};
  input_ = {};
  num_inputs_ = 0;
  decayed_ = 0.0;
}

}  // namespace suspension_health_monitor
