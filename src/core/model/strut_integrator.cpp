#include "suspension_health_monitor/internal/model/strut_integrator.h"

namespace suspension_health_monitor {
namespace {

constexpr double Memory::*kNumbers[] = {&Memory::s, &Memory::second};

Memory advanced(Memory memory, double by, const Memory& rate) {
  for (const auto number : kNumbers) memory.*number += by * rate.*number;
  return memory;
}

/// At one of the instants of a step. The plain strut leaves out everything about effects: it is on the sample path of
/// every monitor.
/// @param travel, travel_rate  as the wheel alone makes them.
/// @param body  the body's part of the motion since the step began, which is taken off, and the memories.
/// @return the rates of all that is in `body`.
template <bool kWithEffects>
StrutState slopeAt(const StrutModel& model, double time, double travel, double travel_rate, const StrutState& body) {
  travel -= body.travel;
  travel_rate -= body.travel_rate;
  StrutState slope;
  slope.travel = body.travel_rate;
  if constexpr (kWithEffects) {
    slope.travel_rate = model.force(travel, travel_rate, time, body.memory.data());
    for (std::size_t j = 0; j < model.effects.size(); ++j)
      slope.memory[j] = model.effects[j].memoryRate({travel, travel_rate, time, body.memory[j], slope.travel_rate});
  } else {
    slope.travel_rate = model.damping_to_mass * travel_rate + model.stiffness_to_mass * travel;
  }
  return slope;
}

template <bool kWithEffects>
void integrate(const StrutModel& model, double time, double step, const WheelStep& wheel, StrutState& state) {
  const auto moved = [&](double by, const StrutState& slope) {
    StrutState body{by * slope.travel, by * slope.travel_rate, {}};
    if constexpr (kWithEffects)
      for (std::size_t j = 0; j < model.effects.size(); ++j)
        body.memory[j] = advanced(state.memory[j], by, slope.memory[j]);
    return body;
  };
  // Travel and its rate as they would go on, plus the wheel's motion; the body's is taken off stage by stage.
  const double half = step / 2;
  const double middle = state.travel + half * state.travel_rate + wheel.middle_position;
  const double middle_rate = state.travel_rate + wheel.middle_velocity;
  const double end = state.travel + step * state.travel_rate + wheel.end_position;
  const double end_rate = state.travel_rate + wheel.end_velocity;
  constexpr auto slope = slopeAt<kWithEffects>;
  const StrutState k1 = slope(model, time, state.travel, state.travel_rate, moved(0.0, {}));
  const StrutState k2 = slope(model, time + half, middle, middle_rate, moved(half, k1));
  const StrutState k3 = slope(model, time + half, middle, middle_rate, moved(half, k2));
  const StrutState k4 = slope(model, time + step, end, end_rate, moved(step, k3));
  const double sixth = step / 6;
  state.travel = end - sixth * (k1.travel + 2 * (k2.travel + k3.travel) + k4.travel);
  state.travel_rate = end_rate - sixth * (k1.travel_rate + 2 * (k2.travel_rate + k3.travel_rate) + k4.travel_rate);
  if constexpr (kWithEffects)
    for (std::size_t j = 0; j < model.effects.size(); ++j)
      for (const auto n : kNumbers)
        state.memory[j].*n += sixth * (k1.memory[j].*n + 2 * (k2.memory[j].*n + k3.memory[j].*n) + k4.memory[j].*n);
}

// How fast a memory changes by itself at some instant [1/s]: |dg/ds| where it forgets; where its two numbers swing,
// twice their angular frequency, as that must last for many steps.
double ownRate(const ActiveEffect& active, const StrutMotion& motion) {
  const Memory before = active.memoryRate(motion);
  const auto slopeBy = [&](double Memory::*number) {
    StrutMotion there = motion;
    const double difference = 1e-3 * std::abs(motion.memory.*number) + 1e-9;
    there.memory.*number += difference;
    const Memory after = active.memoryRate(there);
    return Memory((after.s - before.s) / difference, (after.second - before.second) / difference);
  };
  const Memory by_s = slopeBy(&Memory::s);
  if (by_s.second == 0.0) return std::abs(by_s.s);
  const Memory by_second = slopeBy(&Memory::second);
  return std::max(std::abs(by_s.s + by_second.second), 2.0 * std::sqrt(std::abs(by_s.second * by_second.s)));
}

// In how many parts a step must be taken so that the memories can follow: a hysteresis of short stroke forgets within a
// fraction of a sample when the strut moves fast.
int numParts(const StrutModel& model, const StrutMotion& from, const StrutMotion& to, double step,
             const std::array<Memory, kMostEffects>& memory) {
  double fastest = 0.0;
  for (std::size_t j = 0; j < model.effects.size(); ++j) {
    const ActiveEffect& active = model.effects[j];
    if (!active.effect.memory_rate || active.effect.lasts) continue;  // what lasts is slow
    for (StrutMotion motion : {from, to}) {
      motion.memory = memory[j];
      fastest = std::max(fastest, ownRate(active, motion));
    }
  }
  // Runge-Kutta's limit of stability is 2.8.
  const double parts = std::ceil(fastest * step / (2.0 * kLongestStrutStep));
  return parts < kMostStepsPerSample ? std::max(1, static_cast<int>(parts)) : kMostStepsPerSample;  // NaN, too
}

StrutMotion between(const StrutMotion& from, const StrutMotion& to, double share) {
  const auto at = [share](double a, double b) { return a + share * (b - a); };
  return {at(from.travel, to.travel), at(from.travel_rate, to.travel_rate), at(from.time, to.time), 0.0,
          at(from.body_acceleration, to.body_acceleration)};
}

// The wheel's position within a step is the polynomial of fifth degree with the step's four gains.
// @return the wheel in a part of the step, by both ends of the part in shares of the step.
auto partsOf(const WheelStep& wheel, double step) {
  const double pm = wheel.middle_position, vm = wheel.middle_velocity * step;
  const double pe = wheel.end_position, ve = wheel.end_velocity * step;
  const double c2 = 7 * pe - ve + 16 * pm - 8 * vm, c3 = -34 * pe + 5 * ve - 32 * pm + 32 * vm;
  const double c4 = 52 * pe - 8 * ve + 16 * pm - 40 * vm, c5 = -24 * pe + 4 * ve + 16 * vm;
  return [=](double from, double to) -> WheelStep {
    const auto position = [&](double x) { return x * x * (c2 + x * (c3 + x * (c4 + x * c5))); };
    // Per step:
    const auto velocity = [&](double x) { return x * (2 * c2 + x * (3 * c3 + x * (4 * c4 + x * 5 * c5))); };
    const double middle = (from + to) / 2, start = position(from), rate = velocity(from);
    return {position(middle) - start - (middle - from) * rate, (velocity(middle) - rate) / step,
            position(to) - start - (to - from) * rate, (velocity(to) - rate) / step};
  };
}

void integrateWithEffects(const StrutModel& model, double time, double step, const WheelStep& wheel,
                          StrutState& state) {
  const StrutMotion start{state.travel, state.travel_rate, time};
  const StrutMotion end{state.travel + step * state.travel_rate + wheel.end_position,
                        state.travel_rate + wheel.end_velocity, time};
  const int parts = numParts(model, start, end, step, state.memory);
  if (parts == 1) return integrate<true>(model, time, step, wheel, state);
  const auto part = partsOf(wheel, step);
  for (int i = 0; i < parts; ++i) {
    const double from = static_cast<double>(i) / parts, to = (i + 1.0) / parts;
    integrate<true>(model, time + from * step, step / parts, part(from, to), state);
  }
}

}  // namespace

WheelInterpolator::WheelInterpolator(double from, double to, double period)
    : is_whole_(from == 0.0 && to == 1.0), period_(period) {
  const auto set = [&](Eigen::Index row, double end, int power) {
    const std::vector<double> integral = integrationWeights(from, end, power);
    for (Eigen::Index i = 0; i < kWidth; ++i)
      weights_(i % 2, 4 * (i / 2) + row) = std::pow(period, 1 + power) * integral[i];
  };
  const double middle = (from + to) / 2;
  set(0, to, 1);
  set(1, to, 0);
  set(2, middle, 1);
  set(3, middle, 0);
}

std::vector<WheelInterpolator> WheelInterpolator::ofSample(int steps, double period) {
  std::vector<WheelInterpolator> all;
  for (int i = 0; i < steps; ++i) all.emplace_back(static_cast<double>(i) / steps, (i + 1.0) / steps, period);
  return all;
}

WheelStep WheelInterpolator::ofPart(const double* around) const {
  const auto [position, velocity, middle_position, middle_velocity] = sums<4>(around);
  return {middle_position, middle_velocity, position, velocity};
}

void followMemories(const StrutModel& model, const StrutMotion& from, const StrutMotion& to, double step,
                    std::array<Memory, kMostEffects>& memory) {
  const int parts = numParts(model, from, to, step, memory);
  const double h = step / parts;
  for (std::size_t j = 0; j < model.effects.size(); ++j) {
    const ActiveEffect& active = model.effects[j];
    if (!active.effect.memory_rate) continue;
    const auto rate = [&](double share, const Memory& value) {
      StrutMotion motion = between(from, to, share);
      motion.memory = value;
      return active.memoryRate(motion);
    };
    for (int i = 0; i < parts; ++i) {  // Heun's method
      const Memory start = rate(static_cast<double>(i) / parts, memory[j]);
      const Memory end = rate((i + 1.0) / parts, advanced(memory[j], h, start));
      memory[j] = advanced(advanced(memory[j], h / 2.0, start), h / 2.0, end);
    }
  }
}

void keepLasting(const StrutModel& model, double rest, std::array<Memory, kMostEffects>& memory) {
  for (std::size_t j = 0; j < model.effects.size(); ++j) {
    const ActiveEffect& active = model.effects[j];
    if (!active.effect.lasts || !(rest >= 0.0 && std::isfinite(rest))) {
      memory[j] = {};
      continue;
    }
    const double rate = ownRate(active, {}), gone = -std::expm1(-rate * rest);
    const double at_rest = active.memoryRate({}) / rate;
    if (rate > 0.0) memory[j].s += gone * (at_rest - memory[j].s);
  }
}

void integrateStrut(const StrutModel& model, double time, double step, const WheelStep& wheel, StrutState& state) {
  if (model.effects.empty())
    integrate<false>(model, time, step, wheel, state);
  else
    integrateWithEffects(model, time, step, wheel, state);
}

}  // namespace suspension_health_monitor
