#include "suspension_health_monitor/internal/identification/horizon_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "paper_drive.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"

namespace suspension_health_monitor {
namespace {

struct RoughStrut {
  double b1, b0;

  double naturalFrequency() const { return std::sqrt(b0) / (2.0 * M_PI); }
};

constexpr RoughStrut kStruts[] = {{3.0, 13.8}, {6.0, 63.3},  {5.0, 120.0}, {4.0, 40.0},
                                  {0.5, 40.0}, {13.0, 40.0}, {90.0, 40.0}};

TEST(Transmissibility, Is1AtRestAndAtRootTwoTimesTheNaturalFrequencyWhateverTheDamping) {
  for (const RoughStrut& strut : kStruts) {
    EXPECT_EQ(transmissibility(strut.b1, strut.b0, 0.0), 1.0);
    EXPECT_NEAR(transmissibility(strut.b1, strut.b0, std::sqrt(2.0) * strut.naturalFrequency()), 1.0, 1e-12);
    EXPECT_GT(transmissibility(strut.b1, strut.b0, strut.naturalFrequency()), 1.0);
  }
  // |b1 j w + b0| / |b1 j w| at the natural frequency.
  EXPECT_NEAR(transmissibility(3.0, 13.8, std::sqrt(13.8) / (2.0 * M_PI)), std::hypot(3.0, std::sqrt(13.8)) / 3.0,
              1e-12);
}

// Amplitude of the filter's answer to a sine, from two outputs a quarter of a period apart.
double measuredFilterMagnitude(int horizon, int samples_per_wave) {
  LinearIntegralFilter filter(2, {horizon, 1.0, IntegrationRule::kBandLimited});
  for (int k = 0; k < 4 * horizon; ++k) filter.push(std::sin(2.0 * M_PI * k / samples_per_wave));
  const double first = filter.output(0);
  for (int k = 4 * horizon; k < 4 * horizon + samples_per_wave / 4; ++k)
    filter.push(std::sin(2.0 * M_PI * k / samples_per_wave));
  return std::hypot(first, filter.output(0)) / (horizon * horizon);
}

TEST(IntegralFilterMagnitude, IsWhatTheFilterDoesToASine) {
  for (const int samples_per_wave : {200, 400, 1000})
    EXPECT_NEAR(integralFilterMagnitude(150.0, 1.0 / samples_per_wave), measuredFilterMagnitude(150, samples_per_wave),
                1e-6);
  EXPECT_EQ(integralFilterMagnitude(0.6, 0.0), 1.0);
  EXPECT_NEAR(integralFilterMagnitude(0.6, 1.0 / 0.6), 0.0, 1e-30);
}

TEST(HorizonProposal, MatchesTheThreeDecibelBandwidthsOfSystemAndFilter) {
  for (const RoughStrut& strut : kStruts) {
    const double bandwidth_hz = bandwidth(strut.b1, strut.b0) / (2.0 * M_PI);
    double maximum = 0.0;
    for (int i = 1; i < 20'000; ++i)
      maximum = std::max(maximum, transmissibility(strut.b1, strut.b0, i * 1e-4 * strut.naturalFrequency()));
    EXPECT_NEAR(transmissibility(strut.b1, strut.b0, bandwidth_hz), maximum / std::sqrt(2.0), 1e-4 * maximum);
    EXPECT_NEAR(integralFilterMagnitude(proposeHorizon(strut.b1, strut.b0), bandwidth_hz), 1.0 / std::sqrt(2.0), 1e-12);
    for (int i = 1; i < 1000; ++i) {
      const double above = bandwidth_hz * (1.0 + 0.01 * i);
      EXPECT_LT(transmissibility(strut.b1, strut.b0, above), maximum / std::sqrt(2.0));
    }
  }
}

TEST(HorizonProposal, ScalesWithTime) {
  for (const RoughStrut& strut : kStruts)
    for (const double s : {1e-4, 0.5, 3.0, 1e5}) {
      const double expected = s * proposeHorizon(strut.b1, strut.b0);
      EXPECT_NEAR(proposeHorizon(strut.b1 / s, strut.b0 / (s * s)), expected, 1e-12 * expected);
    }
}

TEST(HorizonProposal, RefusesParametersWithoutAResonance) {
  EXPECT_THROW(proposeHorizon(0.0, 13.8), std::invalid_argument);
  EXPECT_THROW(proposeHorizon(3.0, -1.0), std::invalid_argument);
  EXPECT_THROW(proposeHorizon(std::numeric_limits<double>::quiet_NaN(), 13.8), std::invalid_argument);
}

TEST(HorizonSamples, AreTheNearest) {
  EXPECT_EQ(horizonSamples(0.6, 0.02), 30);
  EXPECT_EQ(horizonSamples(0.613, 0.02), 31);
  EXPECT_EQ(horizonSamples(0.001, 0.02), 1);
  EXPECT_THROW(horizonSamples(0.0, 0.02), std::invalid_argument);
  EXPECT_THROW(horizonSamples(0.6, -1.0), std::invalid_argument);
}

// rms relative error of the live LS estimate over four drives of the golden car.
double errorAt(double horizon) {
  SimulationOptions options;
  options.scenario = "iso_road";
  options.rate = 200.0;
  options.duration = 30.0;
  options.noise = 0.1;
  double sum = 0.0;
  int count = 0;
  for (options.seed = 1; options.seed <= 4; ++options.seed) {
    RecursiveLeastSquares ls(kNumStrutParameters, {0.99, 1e5, InitialVariance::kRelative});
    const int samples = horizonSamples(horizon, 1.0 / options.rate);
    int rows = 0;
    for (const RegressionRow& row :
         strutRows(simulate(options), {samples, 1.0 / options.rate, IntegrationRule::kBandLimited})) {
      ls.update(row);
      if (++rows < 1000) continue;
      ++count;
      sum += std::pow(ls.parameters()[0] / 6.0 - 1.0, 2) + std::pow(ls.parameters()[1] / 63.3 - 1.0, 2);
    }
  }
  return std::sqrt(sum / count);
}

// The full table is in doc/horizon.md.
TEST(HorizonProposal, IsNearTheMeasuredBestForTheGoldenCar) {
  const double proposed = proposeHorizon(6.0, 63.3);
  const double error = errorAt(proposed);
  EXPECT_LT(1.2 * error, errorAt(proposed / 3.0));
  EXPECT_LT(1.5 * error, errorAt(2.5 * proposed));
  for (const double factor : {0.6, 0.8, 1.25, 1.6}) EXPECT_LT(error, 1.15 * errorAt(factor * proposed));
}

}  // namespace
}  // namespace suspension_health_monitor
