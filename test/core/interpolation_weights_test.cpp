#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

constexpr int kHalf = kInterpolationReach;

// Samples around position 0 of sin(omega x + phase), x in samples.
std::vector<double> sineAround(double omega, double phase) {
  std::vector<double> samples;
  for (int i = 0; i < 2 * kHalf; ++i) samples.push_back(std::sin(omega * (i - kHalf + 1) + phase));
  return samples;
}

double sum(const std::vector<double>& weights, const std::vector<double>& samples) {
  return std::inner_product(weights.begin(), weights.end(), samples.begin(), 0.0);
}

TEST(InterpolationWeights, ConstantIsExact) {
  const std::vector<double> gravity(2 * kHalf, 9.81);
  for (const double fraction : {0.0, 0.13, 0.5, 1.0})
    EXPECT_NEAR(sum(interpolationWeights(fraction), gravity), 9.81, 1e-11) << fraction;
}

TEST(InterpolationWeights, FractionsZeroAndOneAreTheTwoMiddleSamples) {
  std::vector<double> samples = sineAround(0.3, 0.4);
  EXPECT_NEAR(sum(interpolationWeights(0.0), samples), samples[kHalf - 1], 1e-4);
  EXPECT_NEAR(sum(interpolationWeights(1.0), samples), samples[kHalf], 1e-4);
}

double worstErrorAt(double share_of_nyquist) {
  const double omega = share_of_nyquist * M_PI;
  double worst = 0.0;
  for (const double fraction : {0.1, 0.25, 0.5, 0.9})
    for (const double phase : {0.0, 0.7, M_PI / 2, 2.0}) {
      const double value = sum(interpolationWeights(fraction), sineAround(omega, phase));
      worst = std::max(worst, std::abs(value - std::sin(omega * fraction + phase)));
    }
  return worst;
}

TEST(InterpolationWeights, SinesUpToHalfOfNyquistAreGoodToATenThousandth) {
  for (const double share : {0.01, 0.1, 0.2, 0.3, 0.4}) EXPECT_LT(worstErrorAt(share), 1e-4) << share;
  EXPECT_LT(worstErrorAt(0.5), 2e-4);
}

TEST(InterpolationWeights, SinesNearNyquistAreBetterThanACubicSplines) {
  EXPECT_LT(worstErrorAt(0.75), 1e-3);
  EXPECT_LT(worstErrorAt(0.88), 2e-2);  // the spline's error there is about 0.5
}

TEST(InterpolationWeights, IntegralIsThatOfASine) {
  for (const double omega : {0.2, 1.0, M_PI / 2})
    for (const double phase : {0.0, 0.7, 2.0})
      for (const auto& [from, to] : std::vector<std::pair<double, double>>{{0.0, 1.0}, {0.0, 0.5}, {0.5, 1.0}}) {
        const std::vector<double> samples = sineAround(omega, phase);
        const double at_from = omega * from + phase, at_to = omega * to + phase;
        const double once = (std::cos(at_from) - std::cos(at_to)) / omega;
        const double weighted =
            (to - from) * std::cos(at_from) / omega - (std::sin(at_to) - std::sin(at_from)) / (omega * omega);
        EXPECT_NEAR(sum(integrationWeights(from, to, 0), samples), once, 2e-4) << omega;
        EXPECT_NEAR(sum(integrationWeights(from, to, 1), samples), weighted, 1e-4) << omega;
      }
}

}  // namespace
}  // namespace suspension_health_monitor
