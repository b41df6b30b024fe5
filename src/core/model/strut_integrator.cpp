#include "suspension_health_monitor/model/strut_integrator.h"

namespace suspension_health_monitor {
namespace {

/// What changes along a step, or how fast: the body's part of the motion since its beginning, and the memories.
struct Along {
  double position = 0.0, velocity = 0.0;
  std::array<double, StrutState::kMostEffects> memory;
};

/// Where the strut is at one of the instants of a step. The plain strut leaves out everything about effects: it is on
/// the sample path of every monitor.
template <bool kWithEffects>
struct Stage {
  const StrutModel& model;
  std::size_t num_effects;

  /// @param travel, travel_rate  as the wheel alone makes them.
  Along slope(double time, double travel, double travel_rate, const Along& body) const {
    travel -= body.position;
    travel_rate -= body.velocity;
    Along slope;
    slope.position = body.velocity;
    slope.velocity = model.damping_to_mass * travel_rate + model.stiffness_to_mass * travel;
    if constexpr (kWithEffects) {
      for (std::size_t j = 0; j < num_effects; ++j) {
        const ActiveEffect& active = model.effects[j];
        const StrutMotion motion{travel, travel_rate, time, body.memory[j]};
        slope.velocity += active.coefficient * active.effect.force(motion, active.shapes.data());
        slope.memory[j] = active.effect.memory_rate ? active.effect.memory_rate(motion, active.shapes.data()) : 0.0;
      }
    }
    return slope;
  }

  Along moved(const StrutState& start, double by, const Along& slope) const {
    Along body;
    body.position = by * slope.position;
    body.velocity = by * slope.velocity;
    if constexpr (kWithEffects)
      for (std::size_t j = 0; j < num_effects; ++j) body.memory[j] = start.memory[j] + by * slope.memory[j];
    return body;
  }
};

template <bool kWithEffects>
void integrate(const StrutModel& model, double time, double step, const WheelStep& wheel, StrutState& state) {
  const Stage<kWithEffects> stage{model, model.effects.size()};
  // Travel and its rate as they would go on, plus the wheel's motion; the body's is taken off stage by stage.
  const double half = step / 2;
  const double middle = state.travel + half * state.travel_rate + wheel.middle_position;
  const double middle_rate = state.travel_rate + wheel.middle_velocity;
  const double end = state.travel + step * state.travel_rate + wheel.end_position;
  const double end_rate = state.travel_rate + wheel.end_velocity;
  const Along k1 = stage.slope(time, state.travel, state.travel_rate, stage.moved(state, 0.0, {0.0, 0.0, {}}));
  const Along k2 = stage.slope(time + half, middle, middle_rate, stage.moved(state, half, k1));
  const Along k3 = stage.slope(time + half, middle, middle_rate, stage.moved(state, half, k2));
  const Along k4 = stage.slope(time + step, end, end_rate, stage.moved(state, step, k3));
  const double sixth = step / 6;
  state.travel = end - sixth * (k1.position + 2 * (k2.position + k3.position) + k4.position);
  state.travel_rate = end_rate - sixth * (k1.velocity + 2 * (k2.velocity + k3.velocity) + k4.velocity);
  if constexpr (kWithEffects)
    for (std::size_t j = 0; j < stage.num_effects; ++j)
      state.memory[j] += sixth * (k1.memory[j] + 2 * (k2.memory[j] + k3.memory[j]) + k4.memory[j]);
}

}  // namespace

WheelInterpolator::WheelInterpolator(double from, double to, double period) {
  const auto set = [&](Eigen::Index row, Eigen::Index first_column, double end, int power) {
    const BandlimitedInterpolator integral = BandlimitedInterpolator::integral(from, end, power);
    for (Eigen::Index i = 0; i < kWidth; ++i)
      weights_(row, 2 * i + first_column) =
          std::pow(period, 1 + power) * integral.weights()[static_cast<std::size_t>(i)];
  };
  const double middle = (from + to) / 2;
  set(0, 0, middle, 1);
  set(1, 0, middle, 0);
  set(0, 1, to, 1);
  set(1, 1, to, 0);
}

void integrateStrut(const StrutModel& model, double time, double step, const WheelStep& wheel, StrutState& state) {
  if (model.effects.empty())
    integrate<false>(model, time, step, wheel, state);
  else
    integrate<true>(model, time, step, wheel, state);
}

}  // namespace suspension_health_monitor
