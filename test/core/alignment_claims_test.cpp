// What the estimates lose when the input comes as it really does: doc/alignment.md.
#include <gtest/gtest.h>

#include "mean_estimates.h"
#include "simulated_drive.h"
#include "suspension_health_monitor/internal/signal/alignment.h"

namespace suspension_health_monitor {
namespace {

class AsItReallyComes : public testing::TestWithParam<const char*> {
 protected:
  AsItReallyComes() {
    ideal_.rate = 1.0 / kAlignedPeriod;
    real_ = ideal_;
    real_.unsprung_rate = 333.0;
    real_.unsprung_phase = 0.0011;
    real_.dropout = 0.02;
  }

  SimulationOptions ideal_ = scenario(GetParam(), 60.0), real_;
};

void expectNear(const MeanEstimates& actual, const MeanEstimates& expected, double share) {
  EXPECT_NEAR(actual.damping, expected.damping, share * expected.damping);
  EXPECT_NEAR(actual.stiffness, expected.stiffness, share * expected.stiffness);
  EXPECT_NEAR(actual.la_damping, expected.la_damping, share * expected.la_damping);
  EXPECT_NEAR(actual.la_stiffness, expected.la_stiffness, share * expected.la_stiffness);
  EXPECT_NEAR(actual.ls_damping, expected.ls_damping, share * expected.ls_damping);
  EXPECT_NEAR(actual.ls_stiffness, expected.ls_stiffness, share * expected.ls_stiffness);
  EXPECT_GT(actual.valid, 0.99);
}

TEST_P(AsItReallyComes, ResamplingOfIdealReadingsChangesNothing) {
  const MeanEstimates paired = identify(ideal_, Alignment::kAuto);
  EXPECT_FALSE(paired.resampled);
  expectNear(identify(ideal_, Alignment::kResampled), paired, 0.002);
}

// 200 Hz and 333 Hz, out of step, readings taken up to 1 ms late, 2 % lost.
TEST_P(AsItReallyComes, EstimatesAreWithinTwoPercentOfThoseFromIdealReadings) {
  real_.sampling_jitter = 0.001;
  const MeanEstimates real = identify(real_, Alignment::kAuto);
  EXPECT_TRUE(real.resampled);
  expectNear(real, identify(ideal_, Alignment::kPaired), 0.02);
}

// Pairs are of no meaning to blocks, which take readings as they are stamped.
TEST_P(AsItReallyComes, PairingWouldLeaveTheEstimateAsItIs) {
  real_.sampling_jitter = 0.001;
  const MeanEstimates paired = identify(real_, Alignment::kPaired), ideal = identify(ideal_, Alignment::kPaired);
  EXPECT_NEAR(paired.damping, ideal.damping, 0.02 * ideal.damping);
  EXPECT_NEAR(paired.stiffness, ideal.stiffness, 0.02 * ideal.stiffness);
  EXPECT_GT(paired.valid, 0.99);
}

// Stamps that are up to 1 ms late of readings that are not. Times of readings that are wrong by 0.3 ms are noise where
// the wheel shakes: nothing on the paper's road, but a bias of the stiffness of rows on an ISO road, see
// doc/alignment.md.
TEST_P(AsItReallyComes, WrongStampsCostNoMoreThanSaid) {
  real_.stamp_jitter = 0.001;
  const MeanEstimates real = identify(real_, Alignment::kAuto), ideal = identify(ideal_, Alignment::kPaired);
  EXPECT_NEAR(real.damping, ideal.damping, 0.02 * ideal.damping);
  EXPECT_NEAR(real.stiffness, ideal.stiffness, 0.02 * ideal.stiffness);
  EXPECT_GT(real.valid, 0.99);
}

// Nobody knows whether such stamps are wrong, or the readings irregular: the interval holds both.
TEST_P(AsItReallyComes, WrongStampsAreWithinTheStandardDeviation) {
  constexpr int kDrives = 4;
  for (int seed = 1; seed <= kDrives; ++seed) {
    ideal_.seed = real_.seed = seed;
    const double ideal = identify(ideal_, Alignment::kPaired).stiffness;
    for (const double jitter : {0.0, 0.0005, 0.001, 0.002}) {
      real_.stamp_jitter = jitter;
      const MeanEstimates real = identify(real_, Alignment::kAuto);
      EXPECT_NEAR(real.stiffness, ideal, 2.0 * real.stiffness_stddev) << jitter << ' ' << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Roads, AsItReallyComes, testing::Values("paper_clean", "iso_road"));

}  // namespace
}  // namespace suspension_health_monitor
