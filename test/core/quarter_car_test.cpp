#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <stdexcept>
#include <vector>

#include "reference/quarter_car_forms.h"

namespace suspension_health_monitor {
namespace {

using Complex = std::complex<double>;

// The paper's strut on the wheel of a car: every parameter has its own size, so that none can stand in for another.
QuarterCar carOnTyre() { return {50.0, 7.0, 150.0, 690.0, 8000.0}; }

// States (z, w, z', w') of road height, (d, v) of wheel acceleration, x at s = j omega: (s - A) x = B, solved as real
// equations for the real and the imaginary part.
template <class Form>
std::vector<Complex> response(const Form& form, Complex s) {
  const Eigen::Index n = form.a.rows();
  Eigen::MatrixXd system(2 * n, 2 * n);
  const Eigen::MatrixXd turned = s.imag() * Eigen::MatrixXd::Identity(n, n);
  system << -form.a, -turned, turned, -form.a;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * n);
  right.head(n) = form.b;
  const Eigen::VectorXd x = system.partialPivLu().solve(right);
  std::vector<Complex> states;
  for (Eigen::Index i = 0; i < n; ++i) states.emplace_back(x[i], x[n + i]);
  return states;
}

TEST(QuarterCar, RoadDrivenFormIsNewtonsLawForBothMasses) {
  const QuarterCar car = carOnTyre();
  const RoadDrivenForm form = roadDrivenForm(car);
  const double z = 0.03, w = -0.02, z_rate = 0.4, w_rate = -0.7, road = 0.05;
  const double strut = 150.0 * (w_rate - z_rate) + 690.0 * (w - z);
  const Eigen::Vector4d expected(z_rate, w_rate, strut / 50.0, (-strut - 8000.0 * (w - road)) / 7.0);
  const Eigen::Vector4d actual = form.a * Eigen::Vector4d(z, w, z_rate, w_rate) + form.b * road;
  EXPECT_LT((actual - expected).norm(), 1e-12 * expected.norm());
}

TEST(QuarterCar, OnlyTheDamperTakesEnergyAway) {
  const QuarterCar car = carOnTyre();
  const Eigen::Vector4d x(0.03, -0.02, 0.4, -0.7);
  // E = M z'^2/2 + m w'^2/2 + K (w-z)^2/2 + K0 w^2/2 on a flat road, so dE/dt = -beta (w' - z')^2.
  const double spring = 690.0 * (x[1] - x[0]);
  const Eigen::Vector4d gradient(-spring, spring + 8000.0 * x[1], 50.0 * x[2], 7.0 * x[3]);
  const double power = gradient.dot(roadDrivenForm(car).a * x);
  EXPECT_NEAR(power, -150.0 * 1.1 * 1.1, 1e-9);
}

TEST(QuarterCar, BodyAndWheelFollowASlowRoadWholly) {
  const RoadDrivenForm form = roadDrivenForm(carOnTyre());
  const Eigen::Vector4d at_rest = -form.a.partialPivLu().solve(form.b);
  EXPECT_LT((at_rest - Eigen::Vector4d(1.0, 1.0, 0.0, 0.0)).norm(), 1e-12);

  const WheelDrivenForm wheel_driven = wheelDrivenForm(carOnTyre());
  EXPECT_NEAR(-(wheel_driven.c * wheel_driven.a.inverse() * wheel_driven.b).value(), 1.0, 1e-12);
}

TEST(QuarterCar, WheelDrivenEigenvaluesAreThoseOfADampedOscillator) {
  const QuarterCar car;  // the paper's: b1 = 3, b0 = 13.8
  const double natural = std::sqrt(690.0 / 50.0);
  const double ratio = 3.0 / (2.0 * natural);
  const Eigen::Matrix2d a = wheelDrivenForm(car).a;
  const double decay = -0.5 * a.trace();
  EXPECT_NEAR(decay, ratio * natural, 1e-12);
  EXPECT_NEAR(std::sqrt(a.determinant() - decay * decay), natural * std::sqrt(1.0 - ratio * ratio), 1e-12);
}

TEST(QuarterCar, WheelDrivenResponseIsEquationTwentySeven) {
  const WheelDrivenForm form = wheelDrivenForm(QuarterCar());
  for (const double omega : {0.5, 3.7, 20.0}) {
    const Complex s(0.0, omega);
    const Complex denominator = s * s + 3.0 * s + 13.8;
    const std::vector<Complex> states = response(form, s);
    // d'' = w'' - z'': a wheel pushed up compresses the strut.
    EXPECT_LT(std::abs(states[0] - 1.0 / denominator), 1e-14);
    EXPECT_LT(std::abs(states[1] - s / denominator), 1e-14);
    EXPECT_LT(std::abs(form.c[0] * states[0] + form.c[1] * states[1] - (3.0 * s + 13.8) / denominator), 1e-13);
  }
}

TEST(QuarterCar, WheelDrivenFormHoldsAboveAnyTyre) {
  const QuarterCar car = carOnTyre();
  const Complex s(0.0, 9.0);
  const std::vector<Complex> states = response(roadDrivenForm(car), s);
  const Complex wheel_acceleration = s * s * states[1];
  const Complex travel = response(wheelDrivenForm(car), s)[0] * wheel_acceleration;
  EXPECT_LT(std::abs(travel - (states[1] - states[0])), 1e-13);
}

TEST(QuarterCar, StiffTyreTendsToTheRigidWheel) {
  const Complex s(0.0, 6.0);
  QuarterCar car = carOnTyre();
  const Complex rigid = (3.0 * s + 13.8) / (s * s + 3.0 * s + 13.8);
  car.tyre_stiffness = 1e7;
  const double error = std::abs(response(roadDrivenForm(car), s)[0] - rigid);
  car.tyre_stiffness = 1e8;
  const double error_of_stiffer = std::abs(response(roadDrivenForm(car), s)[0] - rigid);
  EXPECT_LT(error, 1e-3);
  EXPECT_NEAR(error / error_of_stiffer, 10.0, 0.1);
}

TEST(QuarterCar, RigidWheelHasNoRoadDrivenForm) { EXPECT_THROW(roadDrivenForm(QuarterCar()), std::invalid_argument); }

}  // namespace
}  // namespace suspension_health_monitor
