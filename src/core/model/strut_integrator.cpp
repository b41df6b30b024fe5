#include "suspension_health_monitor/model/strut_integrator.h"

namespace suspension_health_monitor {
namespace {

/// The body's part of the motion since the beginning of the step, and the memories.
struct Body {
  double position = 0.0, velocity = 0.0;
  std::array<double, StrutState::kMostEffects> memory;
};

struct Slope {
  double velocity, acceleration;
  std::array<double, StrutState::kMostEffects> memory;
};

Slope slopeAt(const StrutModel& model, double time, double travel, double travel_rate, const Body& body) {
  Slope slope;
  slope.velocity = body.velocity;
  slope.acceleration = model.force(travel, travel_rate, time, body.memory.data());
  for (std::size_t j = 0; j < model.effects.size(); ++j) {
    const ActiveEffect& active = model.effects[j];
    slope.memory[j] = active.effect.memory_rate
                          ? active.effect.memory_rate({travel, travel_rate, time, body.memory[j]}, active.shapes.data())
                          : 0.0;
  }
  return slope;
}

Body moved(const Body& start, double by, const Slope& slope, std::size_t num_effects) {
  Body body;
  body.position = start.position + by * slope.velocity;
  body.velocity = start.velocity + by * slope.acceleration;
  for (std::size_t j = 0; j < num_effects; ++j) body.memory[j] = start.memory[j] + by * slope.memory[j];
  return body;
}

}  // namespace

WheelInterpolator::WheelInterpolator(double from, double to, double period)
    : period_(period),
      middle_position_(BandlimitedInterpolator::integral(from, (from + to) / 2, 1)),
      middle_velocity_(BandlimitedInterpolator::integral(from, (from + to) / 2, 0)),
      end_position_(BandlimitedInterpolator::integral(from, to, 1)),
      end_velocity_(BandlimitedInterpolator::integral(from, to, 0)) {}

WheelStep WheelInterpolator::operator()(const double* around) const {
  const double square = period_ * period_;
  return {square * middle_position_(around), period_ * middle_velocity_(around), square * end_position_(around),
          period_ * end_velocity_(around)};
}

void integrateStrut(const StrutModel& model, double time, double step, const WheelStep& wheel, StrutState& state) {
  const std::size_t n = model.effects.size();
  const Body start{0.0, 0.0, state.memory};
  // Travel and its rate: as they would go on, plus the wheel's motion, less the body's.
  const auto slope = [&](double by, double position, double velocity, const Body& body) {
    return slopeAt(model, time + by, state.travel + by * state.travel_rate + position - body.position,
                   state.travel_rate + velocity - body.velocity, body);
  };
  const Slope k1 = slope(0.0, 0.0, 0.0, start);
  const Slope k2 = slope(step / 2, wheel.middle_position, wheel.middle_velocity, moved(start, step / 2, k1, n));
  const Slope k3 = slope(step / 2, wheel.middle_position, wheel.middle_velocity, moved(start, step / 2, k2, n));
  const Slope k4 = slope(step, wheel.end_position, wheel.end_velocity, moved(start, step, k3, n));
  const double position = step / 6 * (k1.velocity + 2 * (k2.velocity + k3.velocity) + k4.velocity);
  const double velocity = step / 6 * (k1.acceleration + 2 * (k2.acceleration + k3.acceleration) + k4.acceleration);
  state.travel += step * state.travel_rate + wheel.end_position - position;
  state.travel_rate += wheel.end_velocity - velocity;
  for (std::size_t j = 0; j < n; ++j)
    state.memory[j] += step / 6 * (k1.memory[j] + 2 * (k2.memory[j] + k3.memory[j]) + k4.memory[j]);
}

}  // namespace suspension_health_monitor
