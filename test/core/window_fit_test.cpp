#include "suspension_health_monitor/internal/blocks/window_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "block_drive.h"

namespace suspension_health_monitor {
namespace {

StrutEquations equationsOf(const NoisyDrive& drive) { return {BlockBand(2.0, 1.0 / drive.rate), BlockColumns{}}; }

WindowEstimate estimateOf(const NoisyDrive& drive) {
  StrutEquations equations = equationsOf(drive);
  std::vector<StrutBlock> blocks = sampledBlocks(equations, drive.sample());
  return fitBlocks(equations, blocks, blockTheta(drive.b1, drive.b0), blockPrior());
}

double relativeError(const WindowEstimate& estimate, const NoisyDrive& drive, int i) {
  return estimate.theta[i] / (i == 0 ? drive.b1 : drive.b0) - 1.0;
}

// Mean and its standard deviation.
struct Mean {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  void add(double x) { sum += x, squares += x * x, ++count; }
  double value() const { return sum / count; }
  double stddev() const { return std::sqrt((squares / count - value() * value()) / (count - 1)); }
};

TEST(WindowFit, HoldsTheTruthInNinetyFiveOfAHundredIntervals) {
  constexpr int kDrives = 200;
  for (const double noise : {0.03, 0.3}) {
    std::array<int, 2> hits{};
    std::array<double, 2> squares{};
    NoisyDrive drive;
    drive.seconds = 16.0;
    drive.body_noise = noise;
    drive.wheel_noise = 2.0 * noise;
    for (int seed = 1; seed <= kDrives; ++seed) {
      drive.seed = static_cast<unsigned>(seed);
      const WindowEstimate estimate = estimateOf(drive);
      for (const int i : {0, 1}) {
        const double z = relativeError(estimate, drive, i) / estimate.relativeStddev(i);
        hits[static_cast<std::size_t>(i)] += std::abs(z) < 1.96 ? 1 : 0;
        squares[static_cast<std::size_t>(i)] += z * z;
      }
    }
    for (const std::size_t i : {0, 1}) {
      // 190 with a standard deviation of sqrt(200 * 0.95 * 0.05) = 3.1; three and a half of them.
      EXPECT_GE(hits[i], 179) << "parameter " << i << ", noise " << noise;
      // What holds more is wider than it need be: a chi of 200 degrees is known to 5 %, three of them, and 10 % beside.
      EXPECT_GT(std::sqrt(squares[i] / kDrives), 0.75) << "parameter " << i << ", noise " << noise;
    }
  }
}

TEST(WindowFit, IsSurerByTheRootOfTheNumberOfBlocks) {
  std::array<Mean, 2> short_drives, long_drives;
  NoisyDrive drive;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    drive.seed = seed;
    for (const double seconds : {9.0, 33.0}) {
      drive.seconds = seconds;
      const WindowEstimate estimate = estimateOf(drive);
      EXPECT_EQ(estimate.blocks, seconds == 9.0 ? 7 : 31);
      for (const int i : {0, 1})
        (seconds == 9.0 ? short_drives : long_drives)[static_cast<std::size_t>(i)].add(estimate.relativeStddev(i) /
                                                                                       std::sqrt(estimate.inflation));
    }
  }
  for (const std::size_t i : {0, 1}) {
    const double expected = std::sqrt(31.0 / 7.0);
    EXPECT_NEAR(short_drives[i].value() / long_drives[i].value(), expected, 0.05 * expected);
  }
}

// Three times the motion is nine times the information: of quarters of 1, 1, 1, 9 the last has three times the mean.
TEST(WindowFit, SaysHowMuchMoreTheRoughestQuarterTells) {
  Mean gain;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    NoisyDrive smooth, rough;
    smooth.seconds = 26.0;
    smooth.seed = seed;
    rough.seconds = 10.0;
    rough.wheel_rms = 3.0 * smooth.wheel_rms;
    rough.seed = seed + 50;
    smooth.body_noise = rough.body_noise = 0.3;
    StrutEquations equations = equationsOf(smooth);
    std::vector<StrutBlock> blocks = sampledBlocks(equations, smooth.sample());
    for (StrutBlock& block : sampledBlocks(equations, rough.sample())) {
      block.end += smooth.seconds;
      blocks.push_back(std::move(block));
    }
    ASSERT_EQ(blocks.size(), 32u);
    gain.add(fitBlocks(equations, blocks, blockTheta(smooth.b1, smooth.b0), blockPrior()).roughest);
  }
  EXPECT_NEAR(gain.value(), 3.0, 3.0 * gain.stddev());
}

// White noise of sigma on the body makes H_0 of n^ = sigma^2 h T 3/8 on average, and e is that where the window's
// neighbours differ little from the bin: in the upper bands.
TEST(WindowFit, MeasuresTheSpectrumOfWhatIsUnexplained) {
  NoisyDrive drive;
  drive.seconds = 64.0;
  drive.body_noise = 0.2;
  drive.wheel_noise = 0.0;
  const WindowEstimate estimate = estimateOf(drive);
  const double expected = 0.2 * 0.2 / drive.rate * 2.0 * 0.375;
  const NoiseBands bands(BlockBand(2.0, 1.0 / drive.rate));
  for (int b = 2; b < bands.count(); ++b) {
    // Bins are worth 1 / 1.944 of independent ones, and blocks 1 / 1.167.
    const double cells = 63.0 * bands.size(b) / (2.0 * (WindowFit::kBinCorrelation + WindowFit::kBlockCorrelation));
    EXPECT_NEAR(estimate.noise[b] / expected, 1.0, 4.0 / std::sqrt(cells)) << "band " << b;
  }
}

TEST(WindowFit, IsNotMovedByAnEngineThatShakesTheBodyInOneBand) {
  NoisyDrive drive;
  StrutEquations equations = equationsOf(drive);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    drive.seed = seed;
    SampledStrut quiet = drive.sample(), shaken = quiet;
    for (std::size_t i = 0; i < shaken.body.size(); ++i)
      shaken.body[i] += 2.0 * std::sin(2.0 * M_PI * 13.3 * static_cast<double>(i) / drive.rate);
    std::vector<StrutBlock> before = sampledBlocks(equations, quiet), after = sampledBlocks(equations, shaken);
    const BlockVector truth = blockTheta(drive.b1, drive.b0);
    const WindowEstimate first = fitBlocks(equations, before, truth, blockPrior());
    const WindowEstimate second = fitBlocks(equations, after, truth, blockPrior());
    for (const int i : {0, 1}) {
      EXPECT_LT(std::abs(second.theta[i] / first.theta[i] - 1.0), second.relativeStddev(i));
      EXPECT_LT(std::abs(relativeError(second, drive, i)), 3.0 * second.relativeStddev(i));
    }
    EXPECT_LT(second.explained, 0.9);
  }
}

std::array<Mean, 3> errorsOf50(NoisyDrive drive) {
  std::array<Mean, 3> mean;  // error of b1, of b0, r
  for (drive.seed = 1; drive.seed <= 50; ++drive.seed) {
    const WindowEstimate estimate = estimateOf(drive);
    for (const int i : {0, 1}) mean[static_cast<std::size_t>(i)].add(relativeError(estimate, drive, i));
    mean[2].add(estimate.theta[kBlockWheelShare]);
  }
  return mean;
}

TEST(WindowFit, IsNotBiasedWhicheverSensorHasAllTheNoise) {
  for (const bool wheel : {false, true}) {
    NoisyDrive drive;
    drive.body_noise = wheel ? 0.0 : 0.3;
    drive.wheel_noise = wheel ? 0.03 : 0.0;
    const std::array<Mean, 3> mean = errorsOf50(drive);
    for (const std::size_t i : {0, 1})
      EXPECT_LT(std::abs(mean[i].value()), 3.0 * mean[i].stddev()) << (wheel ? "wheel" : "body") << ", parameter " << i;
  }
}

// Without the wheel's noise in its instruments, b1 would be small by the noise's share of the wheel's power in a bin.
// What the data tell of r is too little to prevent that in the upper bins, where rho needs an r near one.
TEST(WindowFit, IsBiasedByTheWheelsNoiseNoMoreThanItsShareOfTheWheelsPower) {
  for (const double noise : {0.3, 1.0}) {
    NoisyDrive drive;
    drive.body_noise = 0.0;
    drive.wheel_noise = noise;
    const std::array<Mean, 3> mean = errorsOf50(drive);
    const double share =
        std::pow(noise / drive.wheel_rms, 2) * (1.0 / 3.0) / (1.0 / 2.0);  // white to rate / 3, rate / 2
    EXPECT_GT(mean[0].value(), -1.1 * share);
    EXPECT_LT(mean[0].value(), 3.0 * mean[0].stddev());
    EXPECT_LT(std::abs(mean[1].value()), 0.2 * share + 3.0 * mean[1].stddev());
    EXPECT_GT(mean[2].value(), 0.5);  // it is heard that the noise is the wheel's
  }
}

TEST(WindowFit, CountsABlockThatIsUnusuallyNoisyForLess) {
  NoisyDrive drive;
  drive.body_noise = 0.1;
  StrutEquations equations = equationsOf(drive);
  SampledStrut noisy = drive.sample();
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 3.0);
  for (std::size_t i = 640; i < 720; ++i) noisy.body[i] += normal(random);  // 10 s to 11.25 s: three blocks of 31
  std::vector<StrutBlock> blocks = sampledBlocks(equations, noisy);
  const BlockVector truth = blockTheta(drive.b1, drive.b0);
  std::vector<const StrutBlock*> pointers;
  for (StrutBlock& block : blocks) {
    equations.linearise(truth, block);
    pointers.push_back(&block);
  }
  WindowFit fit(equations.band(), equations.columns(), 64);
  WindowEstimate plain, weighted;
  fit.fit(pointers, blockPrior(), truth, {}, 1.0, plain);
  const Eigen::VectorXd usual = Eigen::VectorXd::Constant(equations.noiseBands().count(), 0.01 / drive.rate * 0.75);
  fit.fit(pointers, blockPrior(), truth, usual, 1.0, weighted);
  for (const int i : {0, 1}) {
    EXPECT_LT(weighted.relativeStddev(i), 0.5 * plain.relativeStddev(i));
    EXPECT_LT(std::abs(relativeError(weighted, drive, i)), 3.0 * weighted.relativeStddev(i));
  }
}

}  // namespace
}  // namespace suspension_health_monitor
