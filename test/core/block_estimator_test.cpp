#include "suspension_health_monitor/internal/blocks/block_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "block_drive.h"

namespace suspension_health_monitor {
namespace {

using Estimates = std::vector<std::optional<WindowEstimate>>;

BlockEstimator estimatorOf(const NoisyDrive& drive) { return {BlockBand(2.0, 1.0 / drive.rate), BlockColumns{0, 0}}; }

Estimates feed(BlockEstimator& estimator, const SampledStrut& drive) {
  Estimates result;
  for (const StrutBlock& block : sampledBlocks(estimator.equations(), drive)) {
    estimator.next() = block;
    const WindowEstimate* estimate = estimator.update();
    result.push_back(estimate == nullptr ? std::nullopt : std::optional<WindowEstimate>(*estimate));
  }
  return result;
}

// The second drive after the first: a step, at whose block both are mixed.
SampledStrut joined(const SampledStrut& first, const SampledStrut& second) {
  SampledStrut result = first;
  result.body.insert(result.body.end(), second.body.begin(), second.body.end());
  result.wheel.insert(result.wheel.end(), second.wheel.begin(), second.wheel.end());
  return result;
}

double delayStddev(const WindowEstimate& estimate) { return std::sqrt(estimate.covariance(kBlockDelay, kBlockDelay)); }

TEST(BlockEstimator, EstimatesFromTheThirdBlockOn) {
  const NoisyDrive drive;
  BlockEstimator estimator = estimatorOf(drive);
  const Estimates estimates = feed(estimator, drive.sample());
  EXPECT_FALSE(estimates[1]);
  for (std::size_t i = 2; i < estimates.size(); ++i) {
    ASSERT_TRUE(estimates[i]) << i;
    EXPECT_NEAR(estimates[i]->theta[0], drive.b1, 4.0 * drive.b1 * estimates[i]->relativeStddev(0)) << i;
    EXPECT_NEAR(estimates[i]->theta[1], drive.b0, 4.0 * drive.b0 * estimates[i]->relativeStddev(1)) << i;
  }
}

TEST(BlockEstimator, TakesTheFewestBlocksThatAreSureEnough) {
  for (const double noise : {0.03, 0.8, 4.0}) {
    NoisyDrive drive;
    drive.body_noise = drive.wheel_noise = noise / std::sqrt(2.0);
    drive.seconds = 64.0;
    BlockEstimator estimator = estimatorOf(drive);
    const Estimates estimates = feed(estimator, drive.sample());
    ASSERT_TRUE(estimates.back());
    if (noise < 0.1) {
      EXPECT_EQ(estimates.back()->blocks, kBlockWindows.front());
    } else if (noise < 2.0) {
      EXPECT_GT(estimates.back()->blocks, 6);
      EXPECT_LT(estimates.back()->worst(), kBlockTuning.enough);
    } else {
      EXPECT_EQ(estimates.back()->blocks, 48);  // all of the 63 that a window may take
      EXPECT_GT(estimates.back()->worst(), kBlockTuning.enough);
    }
  }
}

TEST(BlockEstimator, HardlyEverTakesNoiseOfAVehicleThatStandsForAStrutAndSaysNothingOfSilence) {
  NoisyDrive drive;
  drive.wheel_rms = 0.0;
  int said = 0, blocks = 0;
  for (drive.seed = 1; drive.seed <= 10; ++drive.seed) {
    BlockEstimator estimator = estimatorOf(drive);
    for (const auto& estimate : feed(estimator, drive.sample())) {
      said += estimate ? 1 : 0;
      ++blocks;
    }
  }
  EXPECT_GT(blocks, 290);
  EXPECT_LE(said, 3);  // by chance three blocks or four of noise look as if a strut were known to 30 %
  drive.body_noise = drive.wheel_noise = 0.0;
  BlockEstimator estimator = estimatorOf(drive);
  for (const auto& estimate : feed(estimator, drive.sample())) EXPECT_FALSE(estimate);
}

TEST(BlockEstimator, FollowsADamperThatFailsWithinItsShortestWindow) {
  NoisyDrive drive, failed;
  failed.b1 = 0.5 * drive.b1;
  failed.seed = 2;
  BlockEstimator estimator = estimatorOf(drive);
  const Estimates estimates = feed(estimator, joined(drive.sample(), failed.sample()));
  // Blocks 0 to 30 are of the first 32 s, block 31 is mixed, 32 to 34 are the first three of the failed damper.
  for (const std::size_t i : {34, 36, 40}) {
    ASSERT_TRUE(estimates[i]) << i;
    EXPECT_NEAR(estimates[i]->theta[0], failed.b1, 0.1 * failed.b1) << i;
    EXPECT_NEAR(estimates[i]->theta[1], failed.b0, 0.1 * failed.b0) << i;
  }
}

TEST(BlockEstimator, KnowsTheDelayFromAllBlocksAndForgetsItWhereTheNewestContradict) {
  NoisyDrive drive, late;
  drive.delay = 0.002;
  late.delay = -0.004;
  late.seed = 2;
  BlockEstimator estimator = estimatorOf(drive);
  const double prior = estimator.slowPrior().stddev[kBlockDelay];
  const Estimates before = feed(estimator, drive.sample());
  ASSERT_TRUE(before.back());
  EXPECT_LT(estimator.slowPrior().stddev[kBlockDelay], 0.1 * prior);
  EXPECT_NEAR(estimator.slowPrior().mean[kBlockDelay], drive.delay, 1e-4);
  EXPECT_NEAR(before.back()->theta[kBlockDelay], drive.delay, 3.0 * delayStddev(*before.back()));
  const Estimates after = feed(estimator, late.sample());
  for (const std::size_t i : {2, 4, 8}) {
    ASSERT_TRUE(after[i]) << i;
    EXPECT_NEAR(after[i]->theta[kBlockDelay], late.delay, 4.0 * delayStddev(*after[i])) << i;
    EXPECT_LT(delayStddev(*after[i]), 1e-3);
    EXPECT_NEAR(after[i]->theta[0], late.b1, 0.05 * late.b1) << i;
  }
}

TEST(BlockEstimator, GivesTheSameFromAnotherEstimatorsThetaAsFromItsOwnStart) {
  NoisyDrive drive;
  drive.body_noise = drive.wheel_noise = 0.1;
  BlockEstimator own = estimatorOf(drive), begun = estimatorOf(drive);
  begun.begin(blockTheta(1.5 * drive.b1, 0.8 * drive.b0).head(kNumBlockParameters), begun.slowPrior());
  const Estimates first = feed(own, drive.sample()), second = feed(begun, drive.sample());
  for (const std::size_t i : {4, 10, 29}) {
    ASSERT_TRUE(first[i]) << i;
    ASSERT_TRUE(second[i]) << i;
    for (const int j : {0, 1})
      EXPECT_NEAR(first[i]->theta[j] / second[i]->theta[j], 1.0, 0.2 * first[i]->relativeStddev(j)) << i;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
