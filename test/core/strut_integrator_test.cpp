#include "suspension_health_monitor/internal/model/strut_integrator.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {
namespace {

const WheelStep kStill{};

ActiveEffect active(const char* name, double coefficient, std::vector<double> shapes) {
  return {findEffect(forceEffects(), name), coefficient, std::move(shapes)};
}

TEST(StrutModel, ForceSumsTheLinearStrutAndItsEffects) {
  StrutModel model{3.0, 10.0, {}, {}};
  model.effects.push_back(active("stiffness_drift", 2.0, {}));
  model.effects.push_back(active("hysteresis", 5.0, {0.01}));
  const Memory memory[] = {7.0, 0.5};
  // 3 (-0.4) + 10 (0.2) + 2 (4) (0.2) + 5 (0.5)
  EXPECT_NEAR(model.force(0.2, -0.4, 4.0, memory), -1.2 + 2.0 + 1.6 + 2.5, 1e-12);
}

TEST(WheelInterpolator, ConstantAccelerationMovesTheWheelByTheTextbook) {
  const std::vector<double> around(2 * kInterpolationReach, 2.0);
  for (const auto& [from, to] : std::vector<std::pair<double, double>>{{0.0, 1.0}, {0.0, 0.5}, {0.5, 1.0}}) {
    const WheelStep step = WheelInterpolator(from, to, 0.1)(around.data());
    const double h = 0.1 * (to - from);
    EXPECT_NEAR(step.end_velocity, 2.0 * h, 1e-10);
    EXPECT_NEAR(step.end_position, 2.0 * h * h / 2.0, 1e-10);
    EXPECT_NEAR(step.middle_velocity, 2.0 * h / 2.0, 1e-10);
    EXPECT_NEAR(step.middle_position, 2.0 * h * h / 8.0, 1e-10);
  }
}

TEST(WheelInterpolator, HalfStepsAreAtTheirOwnPlace) {
  constexpr double period = 0.1;
  std::vector<double> around;  // sin(2 t), the step from t = 0 to 0.1
  for (int i = 0; i < 2 * kInterpolationReach; ++i)
    around.push_back(std::sin(2.0 * period * (i - kInterpolationReach + 1)));
  const WheelStep second = WheelInterpolator(0.5, 1.0, period)(around.data());
  EXPECT_NEAR(second.end_velocity, (std::cos(0.1) - std::cos(0.2)) / 2.0, 1e-6);
}

TEST(IntegrateStrut, SteadyStateOfASineIsTheTransferFunctions) {
  constexpr double period = 0.01, omega = 12.0, b1 = 3.0, b0 = 13.8;
  constexpr int last = 2000;  // b1/2 20 s = 30: the start has decayed by 1e-13
  const StrutModel model{b1, b0, {}, {}};
  const WheelInterpolator interpolate(0.0, 1.0, period);
  StrutState state;
  for (int k = 0; k < last; ++k) {
    std::vector<double> around;
    for (int i = 0; i < 2 * kInterpolationReach; ++i)
      around.push_back(std::sin(omega * period * (k + i - kInterpolationReach + 1)));
    integrateStrut(model, k * period, period, interpolate(around.data()), state);
    if (k < last - 100) continue;
    // d'' + b1 d' + b0 d = w''.
    const std::complex<double> s(0.0, omega);
    const std::complex<double> travel = std::exp(s * ((k + 1) * period)) / (s * s + b1 * s + b0);
    // As good as the interpolation of w'', see its test.
    ASSERT_NEAR(state.travel, travel.imag(), 1e-4 * std::abs(travel));
    ASSERT_NEAR(state.travel_rate, (s * travel).imag(), 1e-4 * std::abs(s * travel));
  }
}

TEST(IntegrateStrut, UndampedStrutKeepsItsEnergy) {
  StrutModel model{0.0, 20.0, {}, {}};
  model.effects.push_back(active("progressive_spring", 300.0, {3.0}));
  StrutState state;
  state.travel = 0.2;
  const auto energy = [&] {
    return state.travel_rate * state.travel_rate / 2 + 10.0 * state.travel * state.travel +
           75.0 * std::pow(state.travel, 4);
  };
  const double start = energy();
  for (int k = 0; k < 2000; ++k) integrateStrut(model, k * 0.005, 0.005, kStill, state);
  EXPECT_NEAR(energy(), start, 1e-6 * start);
}

TEST(IntegrateStrut, DampedStrutDecaysByItsClosedForm) {
  constexpr double b1 = 2.0, b0 = 26.0;  // -1 +- 5i
  const StrutModel model{b1, b0, {}, {}};
  StrutState state;
  state.travel = 0.1;
  for (int k = 0; k < 100; ++k) integrateStrut(model, k * 0.01, 0.01, kStill, state);
  EXPECT_NEAR(state.travel, 0.1 * std::exp(-1.0) * (std::cos(5.0) + 0.2 * std::sin(5.0)), 1e-8);
  EXPECT_NEAR(state.travel_rate, -0.1 * std::exp(-1.0) * 26.0 / 5.0 * std::sin(5.0), 1e-7);
}

TEST(IntegrateStrut, TimeDependentForceIsTakenAtTheTimeOfTheStep) {
  StrutModel model;
  ForceEffect ramp = findEffect(forceEffects(), "stiffness_drift");
  ramp.force = [](const StrutMotion& m, const double*) { return m.time; };
  model.effects.push_back({ramp, 6.0, {}});
  StrutState state;
  integrateStrut(model, 2.0, 0.5, kStill, state);
  // d'' = -6 t from t = 2 to 2.5: v = -3 (2.5^2 - 2^2), d = -(2.5^3 - 2^3) + 12 (0.5)
  EXPECT_NEAR(state.travel_rate, -6.75, 1e-12);
  EXPECT_NEAR(state.travel, -(15.625 - 8.0) + 6.0, 1e-12);
}

TEST(IntegrateStrut, MemoriesFollowTheirClosedFormsSideBySide) {
  StrutModel model;  // without force the travel goes on as it began
  model.effects.push_back(active("damping_drift", 0.0, {}));
  model.effects.push_back(active("hysteresis", 0.0, {0.05}));
  model.effects.push_back(active("viscoelastic_mount", 0.0, {0.2}));
  StrutState state;
  state.travel_rate = -0.1;
  for (int k = 0; k < 50; ++k) integrateStrut(model, k * 0.01, 0.01, kStill, state);
  EXPECT_NEAR(state.travel, -0.05, 1e-12);
  EXPECT_EQ(state.memory[0], 0.0);
  EXPECT_NEAR(state.memory[1], -(1.0 - std::exp(-0.1 * 0.5 / 0.05)), 1e-8);
  // s' = (-0.1 t - s) / tau
  EXPECT_NEAR(state.memory[2], -0.1 * (0.5 - 0.2 * (1.0 - std::exp(-0.5 / 0.2))), 1e-8);
}

// Strut and load as one linear system of four states, x' = A x, solved by its matrix exponential: d, v, e and e' of
// d'' = -z'', z'' = b1 v + b0 d + mu (2 zeta w e' + w^2 e), e'' = -z'' - 2 zeta w e' - w^2 e.
TEST(IntegrateStrut, ALoadOnASpringMovesAsTheCoupledMassesDo) {
  constexpr double b1 = 3.0, b0 = 60.0, mu = 0.4, f = 4.0, zeta = 0.15, step = 0.01;
  constexpr double w = 2.0 * M_PI * f, damp = 2.0 * zeta * w;
  StrutModel model{b1, b0, {active("load_on_spring", mu, {f, zeta})}, {}};
  Eigen::Matrix4d a;
  a << 0.0, 1.0, 0.0, 0.0,                //
      -b0, -b1, -mu * w * w, -mu * damp,  //
      0.0, 0.0, 0.0, 1.0,                 //
      -b0, -b1, -(1.0 + mu) * w * w, -(1.0 + mu) * damp;
  Eigen::Matrix4d term = Eigen::Matrix4d::Identity(), exponential = term;
  for (int n = 1; n < 30; ++n) exponential += term = term * a * (step / n);
  Eigen::Vector4d expected(0.1, -0.5, 0.0, 0.0);
  StrutState state{0.1, -0.5, {}};
  for (int k = 1; k <= 300; ++k) {
    integrateStrut(model, k * step, step, kStill, state);
    expected = exponential * expected;
    ASSERT_NEAR(state.travel, expected[0], 2e-5) << k;
    ASSERT_NEAR(state.memory[0].s, expected[2], 2e-5) << k;
    ASSERT_NEAR(state.memory[0].second, expected[3], 5e-4) << k;
  }
}

TEST(KeepLasting, HeatGoesAsTheRestIsLongAndNothingElseStays) {
  const StrutModel model{3.0, 13.8, {active("warming", 1.0, {50.0, 0.2}), active("hysteresis", 1.0, {0.01})}, {}};
  const auto after = [&](double rest) {
    std::array<Memory, kMostEffects> memory{0.3, 0.7};
    keepLasting(model, rest, memory);
    EXPECT_EQ(memory[1].s, 0.0);
    return memory[0].s;
  };
  EXPECT_DOUBLE_EQ(after(0.0), 0.3);
  EXPECT_NEAR(after(25.0), -0.04 + 0.34 * std::exp(-0.5), 1e-9);
  EXPECT_EQ(after(-1.0), 0.0);  // the clock has begun anew
  EXPECT_EQ(after(INFINITY), 0.0);
}

TEST(IntegrateStrut, AMemoryThatForgetsWithinAStepFollowsTheWheelThroughIt) {
  StrutModel model;  // without force: d = a t^2 / 2, v = a t
  model.effects.push_back(active("hysteresis", 0.0, {0.02}));
  constexpr double a = 40.0, h = 0.05;
  StrutState state;
  integrateStrut(model, 0.0, h, {a * h * h / 8, a * h / 2, a * h * h / 2, a * h}, state);
  EXPECT_NEAR(state.travel, a * h * h / 2, 1e-14);
  EXPECT_NEAR(state.travel_rate, a * h, 1e-13);
  // s' = (1 - s) d' / x, so s = 1 - exp(-d / x); the step is 5 times as long as the memory at its end.
  EXPECT_NEAR(state.memory[0], 1.0 - std::exp(-a * h * h / 2 / 0.02), 1e-3);
}

TEST(IntegrateStrut, StaysStableWithAMemoryMuchFasterThanTheStep) {
  StrutModel model{3.0, 100.0, {}, {}};
  model.effects.push_back(active("hysteresis", 2.0, {0.001}));
  StrutState state;
  state.travel_rate = 1.0;
  for (int k = 0; k < 500; ++k) {
    integrateStrut(model, k * 0.02, 0.02, kStill, state);
    ASSERT_LT(std::abs(state.memory[0]), 1.01) << k;  // Dahl's force saturates at c
  }
  EXPECT_LT(std::abs(state.travel), 0.03);  // stuck or at rest: no further than the friction can hold, c / b0
}

}  // namespace
}  // namespace suspension_health_monitor
