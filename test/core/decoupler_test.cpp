#include "suspension_health_monitor/internal/vehicle/decoupler.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <complex>

namespace suspension_health_monitor {
namespace {

/// Struts that are all alike.
BodyRows rowsOf(const StrutMatrix& ratios, const StrutModel& model, const Eigen::MatrixXd& forces) {
  const Eigen::Index n = ratios.rows();
  BodyRows rows;
  rows.rate = model.damping_to_mass * ratios;
  rows.travel = model.stiffness_to_mass * ratios;
  rows.force = forces;
  rows.covariance.assign(static_cast<std::size_t>(n), 1e-8 * Eigen::MatrixXd::Identity(2 * n, 2 * n));
  return rows;
}

// A body on four struts.
StrutMatrix ratiosOfFour() {
  StrutMatrix ratios(4, 4);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const auto x = [](int k) { return k < 2 ? 1.1 : -1.4; };
      const auto y = [](int k) { return k % 2 == 0 ? 0.7 : -0.7; };
      const auto mobility = [&](int a, int b) { return 1.0 / 1250.0 + x(a) * x(b) / 1900.0 + y(a) * y(b) / 450.0; };
      ratios(i, j) = mobility(i, j) / mobility(j, j);
    }
  return ratios;
}

TEST(TravelObserver, IntegratesASineTwiceAsLateAsItSays) {
  constexpr double kPeriod = 0.01, kStiffness = 60.0, kOffset = 0.3;
  constexpr int kNatural = 82;
  for (const double frequency : {1.2, 2.0, 5.0, 12.0}) {
    TravelObserver observer(kPeriod, kStiffness, kNatural);
    const double omega = 2.0 * M_PI * frequency;
    double worst = 0.0, worst_rate = 0.0;
    for (int k = 0; k < 9000; ++k) {
      observer.push(kOffset + std::sin(omega * k * kPeriod));
      if (k < 6000) continue;
      const double then = omega * (k - TravelObserver::delayOf(kNatural)) * kPeriod;
      worst = std::fmax(worst, std::abs(observer.travel() + std::sin(then) / (omega * omega)));
      worst_rate = std::fmax(worst_rate, std::abs(observer.travelRate() + std::cos(then) / omega));
    }
    // At the natural frequency the washout is 0.7 % off, and the mean of forty seconds 0.3 %.
    EXPECT_LT(worst, 0.045 / (omega * omega)) << frequency;
    EXPECT_LT(worst_rate, 0.045 / omega) << frequency;
  }
}

// A body that heaves on four struts, faster and slower than they are, and that a known force lifts: what is left of
// body and wheel are those of a strut, (b1 s + b0) (W - S) = s^2 S, by their Fourier coefficients.
TEST(Decoupler, LeavesEveryStrutItsOwnHoweverSlowTheBodyMoves) {
  constexpr double kPeriod = 0.01, kDamping = 3.0, kStiffness = 60.0, kForce = 400.0;
  constexpr int kFirst = 6000, kEnd = 26000;  // whole periods of all frequencies
  const StrutModel model{kDamping, kStiffness, {}, {}};
  const StrutMatrix ratios = ratiosOfFour();
  const Eigen::Vector4d forces(1e-3, -2e-3, 3e-3, 1e-3);
  for (const double frequency : {0.3, 0.6, 1.2, 3.0}) {
    Decoupler decoupler(kPeriod, rowsOf(ratios, model, forces), std::vector<StrutModel>(4, model));
    const double omega = 2.0 * M_PI * frequency;
    const std::complex<double> strut(kStiffness, kDamping * omega);
    std::array<std::complex<double>, 4> sprung{}, unsprung{};
    for (int k = 0; k < kEnd; ++k) {
      const double t = kPeriod * k, own = (strut * std::polar(1.0, omega * t)).imag();
      VehicleSample sample{fromSeconds(t + 1.0), StrutVector(4), StrutVector(4), ForceVector(1)};
      const double moving = kForce * std::cos(0.5 * omega * t);
      sample.forces[0] = 5000.0 + moving;
      sample.sprung = ratios * StrutVector::Constant(4, own) + forces * moving;
      sample.unsprung = sample.sprung.array() - omega * omega * std::sin(omega * t);
      const VehicleSample* found = decoupler.push(sample);
      if (found == nullptr || k < kFirst) continue;
      for (std::size_t i = 0; i < 4; ++i) {
        sprung[i] += std::polar(1.0, -omega * t) * found->ofStrut(i).sprung_acceleration;
        unsprung[i] += std::polar(1.0, -omega * t) * found->ofStrut(i).unsprung_acceleration;
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const std::complex<double> told = strut * (unsprung[i] - sprung[i]) / (-omega * omega);
      EXPECT_LT(std::abs(told - sprung[i]) / std::abs(sprung[i]), 0.03) << frequency << " Hz, strut " << i;
    }
  }
}

// One damper's orifice, a wheel that hops beyond the filter, and three struts that do nothing: what is left at their
// tops is nothing where the model of the first sees its travel as it was.
TEST(Decoupler, BehindAFilterTakesOffTheLawAsItIs) {
  constexpr double kPeriod = 0.01, kDamping = 3.0, kStiffness = 60.0, kOrifice = 5.0;
  const std::vector<double> taps{0.1, 0.2, 0.4, 0.2, 0.1};  // 18 Hz are damped to a fifth
  StrutModel orifice{kDamping, kStiffness, {{findEffect(forceEffects(), "quadratic_damping"), kOrifice, {}}}, {}};
  const StrutModel linear{kDamping, kStiffness, {}, {}};
  const StrutMatrix ratios = ratiosOfFour();
  const auto swing = [](double t, int derivative) {
    double sum = 0.0;
    for (const auto& [amplitude, frequency] : {std::array{0.02, 2.0}, std::array{0.003, 18.0}}) {
      const double omega = 2.0 * M_PI * frequency;
      sum += amplitude * std::pow(omega, derivative) * std::sin(omega * t + derivative * M_PI / 2.0);
    }
    return sum;
  };
  const auto own = [&](double t) {
    const double rate = swing(t, 1);
    return kDamping * rate + kStiffness * swing(t, 0) + kOrifice * rate * std::abs(rate);
  };
  const auto passed = [&](const auto& signal, double t) {
    double sum = 0.0;
    for (int k = -2; k <= 2; ++k) sum += taps[static_cast<std::size_t>(k + 2)] * signal(t + kPeriod * k);
    return sum;
  };
  const auto leftBy = [&](const std::vector<double>& low_pass) {
    Decoupler decoupler(kPeriod, rowsOf(ratios, linear, Eigen::MatrixXd(4, 0)), {orifice, linear, linear, linear},
                        low_pass);
    double left = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double t = kPeriod * k, told = passed(own, t);
      VehicleSample sample{fromSeconds(t + 1.0), ratios.col(0) * told, StrutVector(4), ForceVector(0)};
      sample.unsprung = sample.unfiltered = sample.sprung;
      sample.unsprung[0] += passed([&](double at) { return swing(at, 2); }, t);
      sample.unfiltered[0] += swing(t, 2);
      const VehicleSample* found = decoupler.push(sample);
      if (found == nullptr || k < 2000) continue;
      for (int i = 1; i < 4; ++i) left += std::pow(found->sprung[i], 2) / 3000.0;
    }
    return std::sqrt(left);
  };
  double size = 0.0;
  for (int k = 0; k < 1000; ++k) size += std::pow(passed(own, kPeriod * k), 2) / 1000.0;
  // The observer is right to a few percent.
  const double with = leftBy(taps), without = leftBy({});
  EXPECT_LT(with, 0.02 * std::sqrt(size));
  EXPECT_GT(without, 3.0 * with);
}

TEST(Decoupler, PassesWhatNoNeighbourTouchesAndSaysHowLate) {
  const StrutModel model{3.0, 60.0, {}, {}};
  Decoupler decoupler(0.01, rowsOf(StrutMatrix::Identity(2, 2), model, Eigen::MatrixXd(2, 0)), {model, model});
  VehicleSample sample{Stamp(0), StrutVector(2), StrutVector(2), ForceVector(0)};
  int given = 0;
  for (int k = 0; k < 1000; ++k) {
    sample.stamp = fromSeconds(0.01 * (k + 1));
    for (int i = 0; i < 2; ++i) {
      sample.sprung[i] = 9.81 + std::sin(0.1 * k + i);
      sample.unsprung[i] = 9.81 + 3.0 * std::cos(0.3 * k - i);
    }
    const VehicleSample* own = decoupler.push(sample);
    if (own == nullptr) continue;
    ++given;
    EXPECT_EQ(own->stamp, fromSeconds(0.01 * (k + 1 - decoupler.delay())));
    const int then = k - decoupler.delay();
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(own->sprung[i], 9.81 + std::sin(0.1 * then + i), 1e-6);
      EXPECT_NEAR(own->unsprung[i], 9.81 + 3.0 * std::cos(0.3 * then - i), 1e-6);
    }
  }
  EXPECT_GT(given, 500);
  decoupler.startNewSeries();
  EXPECT_EQ(decoupler.push(sample), nullptr);
}

}  // namespace
}  // namespace suspension_health_monitor
