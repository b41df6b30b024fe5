#include "suspension_health_monitor/internal/model/free_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

constexpr double kMeanMemory = 100.0;  // natural periods

using Split = std::vector<WheelInterpolator>;

// A sample as 1, 2, 4, .. steps, in samples; made once, so that no run has to do it while samples come.
const std::vector<Split>& splits() {
  static const std::vector<Split> all = [] {
    std::vector<Split> made;
    for (int steps = 1; steps <= kMostStepsPerSample; steps *= 2)
      made.push_back(WheelInterpolator::ofSample(steps, 1.0));
    return made;
  }();
  return all;
}

// Takes out of a step of the wheel what a constant acceleration alone would do.
void takeOff(double constant, double step, WheelStep& wheel) {
  const double velocity = step * constant, position = step * velocity / 2;
  wheel.middle_position -= position / 4;
  wheel.middle_velocity -= velocity / 2;
  wheel.end_position -= position;
  wheel.end_velocity -= velocity;
}

void check(const ActiveEffect& active) {
  if (!active.effect.force) throw std::invalid_argument("effect " + active.effect.name + ": no force, must be a law");
  if (active.shapes.size() != active.effect.shapes.size())
    throw std::invalid_argument("effect " + active.effect.name + ": " + std::to_string(active.shapes.size()) +
                                " shapes, must be " + std::to_string(active.effect.shapes.size()));
  if (!std::isfinite(active.coefficient))
    throw std::invalid_argument("effect " + active.effect.name + ": coefficient must be finite");
  for (std::size_t i = 0; i < active.shapes.size(); ++i)
    requireAllowed(active.effect.name + '/' + active.effect.shapes[i].name, active.effect.shapes[i], active.shapes[i]);
}

}  // namespace

FreeRun::FreeRun(double period) : period_(period) {
  requireAboveZero("sample_period", period, "s");
  splits();
}

bool FreeRun::trySetModel(double damping_to_mass, double stiffness_to_mass) {
  if (!(damping_to_mass > 0.0 && stiffness_to_mass > 0.0)) return false;  // NaN, too
  const double steps = stepsPerSample(damping_to_mass, stiffness_to_mass, period_);
  if (!(steps <= kMostStepsPerSample)) return false;
  if (hasModel()) state_.travel *= model_.stiffness_to_mass / stiffness_to_mass;
  model_.damping_to_mass = damping_to_mass;
  model_.stiffness_to_mass = stiffness_to_mass;
  steps_ = &*std::find_if(splits().begin(), splits().end(),
                          [&](const Split& split) { return steps <= static_cast<double>(split.size()); });
  decay_rate_ = slowestDecay(damping_to_mass, stiffness_to_mass);
  mean_.memory = kMeanMemory * 2 * M_PI / (period_ * std::sqrt(stiffness_to_mass));
  return true;
}

void requireUsable(const std::vector<ActiveEffect>& effects) {
  if (effects.size() > kMostEffects)
    throw std::invalid_argument(std::to_string(effects.size()) + " effects, must be at most " +
                                std::to_string(kMostEffects));
  for (const ActiveEffect& active : effects) check(active);
}

void FreeRun::setEffects(const std::vector<ActiveEffect>& effects) {
  requireUsable(effects);
  model_.effects = effects;
  state_.memory = {};
  forces_ = {};
  if (decayed_ > 0.0) countTravelFrom(effects.empty() ? 0.0 : mean_.value);
}

std::optional<double> FreeRun::push(double unsprung_acceleration, double time) {
  const double answered = time - kDelay * period_;
  if (decayed_ > 0.0) advance(answered - period_);
  input_.push(unsprung_acceleration);
  mean_.add(unsprung_acceleration);
  if (!input_.full() || !hasModel()) return std::nullopt;
  if (decayed_ == 0.0) startAnew(answered);
  const double prediction = predict(answered);
  last_time_ = answered;
  decayed_ += decay_rate_ * period_;
  if (withEffects() && ranAway(prediction)) {
    ++runaways_;
    state_ = {};
    startAnew(answered);
    return std::nullopt;
  }
  return prediction;
}

// From the sample at `time` to the next.
void FreeRun::advance(double time) {
  const double square = period_ * period_, step = period_ / static_cast<double>(steps_->size());
  for (const WheelInterpolator& interpolate : *steps_) {
    WheelStep wheel = interpolate(input_.window());  // in samples
    wheel.middle_position *= square;
    wheel.middle_velocity *= period_;
    wheel.end_position *= square;
    wheel.end_velocity *= period_;
    if (withEffects()) takeOff(offset_, step, wheel);
    integrateStrut(model_, time, step, wheel, state_);
    time += step;
  }
}

double FreeRun::predict(double time) {
  if (withEffects()) countTravelFrom(mean_.value);  // else from 0
  double prediction = offset_ + model_.damping_to_mass * state_.travel_rate + model_.stiffness_to_mass * state_.travel;
  for (std::size_t j = 0; j < model_.effects.size(); ++j) {
    const ActiveEffect& active = model_.effects[j];
    forces_[j] = active.effect.force({state_.travel, state_.travel_rate, time, state_.memory[j]}, active.shapes.data());
    prediction += active.coefficient * forces_[j];
  }
  return prediction;
}

void FreeRun::countTravelFrom(double offset) {
  state_.travel -= (offset - offset_) / model_.stiffness_to_mass;
  offset_ = offset;
}

bool FreeRun::ranAway(double prediction) {
  largest_ = std::max(largest_, std::abs(input_.at(0)));
  // Forces that cancel each other in the prediction stand in columns of the regression one by one.
  const bool usable = std::all_of(forces_.begin(), forces_.begin() + model_.effects.size(),
                                  [](double force) { return isUsable(force); });
  return !usable || !(std::abs(prediction) <= kRunaway * largest_);  // NaN, too
}

// At rest under the constant part of the input.
void FreeRun::startAnew(double time) {
  keepLasting(model_, time - last_time_, state_.memory);
  state_ = {0.0, 0.0, state_.memory};
  offset_ = mean_.value;
  if (!withEffects()) countTravelFrom(0.0);
  decayed_ = 0.0;
}

void FreeRun::reset() {
  state_ = {0.0, 0.0, state_.memory};
  decayed_ = 0.0;
  input_.reset();
  largest_ = 0.0;
}

}  // namespace suspension_health_monitor
