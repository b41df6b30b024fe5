// What the paper claims and what the live defaults promise, over 20 noise seeds. The bounds are the figures of
// doc/defaults.md (tables small_divisor) with a margin: 20 other seeds change the medians by up to 2 % in b1, 9 % in
// b0.
#include <gtest/gtest.h>

#include <vector>

#include "estimation_error.h"

namespace suspension_health_monitor {
namespace {

constexpr int kNumSeeds = 20;

MonitorSettings liveOptionsWithThePapersDivisor() {
  MonitorSettings options = liveOptions();
  options.estimators.small_divisor_rule = SmallDivisor::kAbsolute;
  options.estimators.small_divisor = 1e-8;
  return options;
}

struct Medians {
  EstimatorErrors paper, live, live_with_papers_divisor;
};

Medians mediansIn(const std::string& scenario) {
  std::vector<EstimatorErrors> paper, live, live_with_papers_divisor;
  for (int seed = 1; seed <= kNumSeeds; ++seed) {
    const std::vector<DriveSample> drive = paperExperiment(scenario, seed);
    paper.push_back(rmsErrors(drive, paperOptions()));
    live.push_back(rmsErrors(drive, liveOptions()));
    live_with_papers_divisor.push_back(rmsErrors(drive, liveOptionsWithThePapersDivisor()));
  }
  return {medianOf(paper), medianOf(live), medianOf(live_with_papers_divisor)};
}

void expectAtMost(const ParameterError& error, double damping_to_mass, double stiffness_to_mass) {
  EXPECT_LE(error.damping_to_mass, damping_to_mass);
  EXPECT_LE(error.stiffness_to_mass, stiffness_to_mass);
}

void expectAtLeast(const ParameterError& error, double damping_to_mass, double stiffness_to_mass) {
  EXPECT_GE(error.damping_to_mass, damping_to_mass);
  EXPECT_GE(error.stiffness_to_mass, stiffness_to_mass);
}

TEST(PaperClaims, WithoutFaultBothEstimatorsFollowTheDampingRamp) {
  const Medians medians = mediansIn("paper_clean");
  expectAtMost(medians.paper.ls, 0.055, 0.19);
  expectAtMost(medians.paper.la, 0.08, 0.12);
  expectAtMost(medians.live.la, 0.08, 0.13);
  // Rows that are hit exactly freeze a direction of P under the absolute rule, and the estimate lags on the ramp.
  EXPECT_LT(medians.live.la.damping_to_mass, 0.7 * medians.live_with_papers_divisor.la.damping_to_mass);
}

TEST(PaperClaims, LossOfDataThrowsLeastSquaresOffAndLeavesLeastAbsoluteAlone) {
  const Medians medians = mediansIn("paper_outliers");
  expectAtLeast(medians.paper.ls, 0.45, 0.70);
  expectAtMost(medians.paper.la, 0.09, 0.16);
  expectAtMost(medians.live.la, 0.08, 0.13);
  EXPECT_NEAR(medians.live_with_papers_divisor.la.damping_to_mass, 0.11, 0.01);
}

TEST(PaperClaims, EndStopsThrowLeastSquaresOffAndLeaveLeastAbsoluteAlone) {
  const Medians medians = mediansIn("paper_saturation");
  expectAtLeast(medians.paper.ls, 0.30, 6.0);
  expectAtMost(medians.paper.la, 0.085, 0.13);
  expectAtMost(medians.live.la, 0.08, 0.13);
}

TEST(PaperClaims, LiveDefaultsAreThoseOfTheTable) {
  const MonitorSettings options;
  EXPECT_EQ(options.forgettingFactor(0.02), 0.99);
  EXPECT_EQ(options.estimators.small_divisor_rule, SmallDivisor::kRelative);
  EXPECT_EQ(options.estimators.small_divisor, 0.2);
  EXPECT_EQ(options.integration_rule, IntegrationRule::kBandLimited);
}

}  // namespace
}  // namespace suspension_health_monitor
