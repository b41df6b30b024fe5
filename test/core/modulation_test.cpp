#include <gtest/gtest.h>

#include <cmath>

#include "block_drive.h"
#include "suspension_health_monitor/internal/blocks/block_bins.h"

namespace suspension_health_monitor {
namespace {

const BlockBand kBand(2.0, 0.01);
constexpr double kStart = 0.3;                    // of the block [s]
constexpr double kEndWeight = M_PI * M_PI / 2.0;  // second derivative of hann at both ends, 2 pi^2 / T^2

Exponentials anyMotion() {
  Exponentials motion = severalSines();
  motion.addFreeDecay(2.0, 4.2, 52.0);
  motion.terms.push_back({0.7, 0.0});
  return motion;
}

Eigen::ArrayXcd modulated(std::size_t p, const Eigen::ArrayXcd& integrals, double delay = 0.0) {
  Modulation modulation(kBand);
  modulation.setDelay(delay);
  Eigen::ArrayXcd result;
  modulation.apply(p, integrals, result);
  return result;
}

double derivative(const Exponentials& signal, double t, int p) {
  double sum = 0.0;
  for (const auto& [c, s] : signal.terms) sum += (c * std::pow(s, p) * std::exp(s * t)).real();
  return sum;
}

// Of hann(t) e^(-j w t) times the p-th derivative. All derivatives of the integrand are bounded: Simpson's rule.
Complex bySimpson(const Exponentials& signal, double omega, int p) {
  constexpr int kSteps = 8000;
  const double h = kBand.length / kSteps;
  Complex sum;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = i * h, hann = 0.5 * (1.0 - std::cos(2.0 * M_PI * t / kBand.length));
    const double weight = (i == 0 || i == kSteps) ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * h / 3.0 * hann * std::exp(Complex(0.0, -omega * t)) * derivative(signal, kStart + t, p);
  }
  return sum;
}

TEST(Modulation, IsTheIntegralOfHannTimesTheDerivativeUpToTheSecond) {
  const Exponentials motion = anyMotion();
  for (const int p : {0, 1, 2}) {
    const Eigen::ArrayXcd found = modulated(static_cast<std::size_t>(p), exactIntegrals(kBand, motion, kStart));
    for (int i = 0; i < kBand.size(); ++i) {
      const Complex expected = bySimpson(motion, kBand.omega(kBand.first + i), p);
      ASSERT_NEAR(std::abs(found[i] - expected), 0.0, 1e-9 * found.abs().maxCoeff()) << "p " << p << " bin " << i;
    }
  }
}

TEST(Modulation, LacksTheTermOfTheEndsInTheThirdDerivative) {
  const Exponentials motion = anyMotion();
  const Eigen::ArrayXcd found = modulated(3, exactIntegrals(kBand, motion, kStart));
  const double ends = kEndWeight * (motion.at(kStart + kBand.length) - motion.at(kStart));
  for (int i = 0; i < kBand.size(); ++i) {
    const Complex expected = bySimpson(motion, kBand.omega(kBand.first + i), 3) - ends;
    ASSERT_NEAR(std::abs(found[i] - expected), 0.0, 1e-9 * found.abs().maxCoeff()) << "bin " << i;
  }
}

TEST(Modulation, OfReadingsIsTheIntegralUpToTheTrapezoidRulesErrorAtTheEnds) {
  const Exponentials motion = severalSines();
  for (const double rate : {100.0, 200.0}) {
    FourierIntegrals stream(kBand, 1);
    FourierIntegrals::Phases phases(kBand);
    for (int i = 0; i <= 2 * rate; ++i) {
      const double t = i / rate, value = motion.at(kStart + t);
      stream.push(t, &value, phases);
    }
    const double jump = std::abs(motion.at(kStart + kBand.length) - motion.at(kStart));
    const double bend = std::abs(derivative(motion, kStart + kBand.length, 1) - derivative(motion, kStart, 1));
    const Eigen::ArrayXcd sampled = wholeBlock(kBand, stream, 1), exact = exactIntegrals(kBand, motion, kStart);
    for (const int p : {0, 1, 2}) {
      const auto order = static_cast<std::size_t>(p);
      const Eigen::ArrayXd error = (modulated(order, sampled) - modulated(order, exact)).abs();
      for (int i = 0; i < kBand.size(); ++i) {
        // h^2 / 12 times the jump of the integrand's derivative from end to end; it has none for p = 0. The
        // next order adds up to (h w)^2 / 10 to h w = 1.3 of the last bin, and some by the motion's own frequencies.
        const double omega = kBand.omega(kBand.first + i);
        const double slope = p == 0 ? 0.0 : kEndWeight * (p == 1 ? jump : bend + 3.0 * omega * jump);
        ASSERT_LT(error[i], 1.5 / (12.0 * rate * rate) * slope + 1e-5) << "p " << p << " bin " << i;
      }
    }
  }
}

TEST(Modulation, TakesADelayFromAPeriodicSignalExactly) {
  Exponentials motion;
  motion.addSine(1.0, 1.5, 0.2).addSine(2.0, 6.0, 1.0).addSine(0.5, 17.5, 2.0);
  const Eigen::ArrayXcd exact = exactIntegrals(kBand, motion, kStart);
  const Eigen::ArrayXcd late = exactIntegrals(kBand, motion.delayed(0.007), kStart);
  for (const std::size_t p : {0, 1, 2, 3})
    EXPECT_LT((modulated(p, late, 0.007) - modulated(p, exact)).abs().maxCoeff(),
              1e-12 * modulated(p, exact).abs().maxCoeff());
}

// The modulating function turns round the block: what leaves at one end, where it is as small as t^2, comes in at the
// other.
TEST(Modulation, TakesADelayFromAnySignalUpToWhatLeavesTheBlock) {
  const Exponentials motion = severalSines();
  double largest = 0.0;
  for (const auto& term : motion.terms) largest += std::abs(term.amplitude);
  const double tau = 0.007, scale = 2.0 * largest * kEndWeight;
  const Eigen::ArrayXcd exact = exactIntegrals(kBand, motion, kStart);
  const Eigen::ArrayXcd late = exactIntegrals(kBand, motion.delayed(tau), kStart);
  for (const std::size_t p : {0, 1, 2}) {
    const Eigen::ArrayXd error = (modulated(p, late, tau) - modulated(p, exact)).abs();
    for (int i = 0; i < kBand.size(); ++i) {
      const double turn = kBand.omega(kBand.first + i) * tau;
      const double bounds[] = {tau * tau * tau / 6.0, tau * tau / 2.0 * (1.0 + turn / 3.0),
                               tau * (1.0 + turn + turn * turn / 6.0)};
      ASSERT_LT(error[i], scale * bounds[p]) << "p " << p << " bin " << i;
    }
  }
}

TEST(Modulation, LeavesNothingOfAConstantAndOfADriftWhatItsClosedFormSays) {
  Exponentials constant;
  constant.terms.push_back({9.81, 0.0});
  for (const std::size_t p : {0, 1, 2, 3})
    EXPECT_LT(modulated(p, exactIntegrals(kBand, constant, 0.0)).abs().maxCoeff(),
              1e-14 * std::pow(kBand.omega(kBand.last), static_cast<double>(p)));

  // The integral of t e^(-j w_k t) is j T / w_k.
  Eigen::ArrayXcd drift(kBand.spectrumSize());
  for (int i = 0; i < drift.size(); ++i) drift[i] = {0.0, kBand.length / kBand.omega(kBand.first - 1 + i)};
  const Eigen::ArrayXcd left = modulated(0, drift);
  for (int i = 0; i < kBand.size(); ++i) {
    const double k = kBand.first + i;
    EXPECT_NEAR(std::abs(left[i]), kBand.length * kBand.length / (4.0 * M_PI * k * (k * k - 1.0)), 1e-12);
  }
  for (const std::size_t p : {1, 2}) EXPECT_LT(modulated(p, drift).abs().maxCoeff(), 1e-11);
}

}  // namespace
}  // namespace suspension_health_monitor
