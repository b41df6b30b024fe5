#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "block_drive.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"

namespace suspension_health_monitor {
namespace {

using Sensor = VehicleReading::Sensor;

std::vector<VehicleReading> readingsOf(const SampledStrut& drive, double begin = 0.0) {
  std::vector<VehicleReading> result;
  for (std::size_t i = 0; i < drive.body.size(); ++i) {
    const Stamp stamp = fromSeconds(begin + static_cast<double>(i) / drive.rate);
    result.push_back(readingOf(Side::kSprung, stamp, drive.body[i]));
    result.push_back(readingOf(Side::kUnsprung, stamp, drive.wheel[i]));
  }
  return result;
}

std::vector<TopEstimate> feed(VehicleBlocks& blocks, const std::vector<VehicleReading>& readings) {
  std::vector<TopEstimate> result;
  for (const VehicleReading& reading : readings)
    if (const TopEstimate* estimate = blocks.push(reading)) result.push_back(*estimate);
  return result;
}

// A strut with Coulomb's friction above a wheel that moves by lines up to a fifth of the rate, by small steps.
SampledStrut withFriction(const NoisyDrive& drive, double friction) {
  constexpr int kSteps = 20;
  constexpr double kLines = 0.31;  // apart [Hz]
  const double h = 1.0 / drive.rate / kSteps, highest = drive.rate / 5.0;
  std::mt19937 random(drive.seed);
  std::normal_distribution<double> normal;
  std::vector<Complex> lines, turns;
  for (double f = kLines; f < highest; f += kLines) {
    lines.push_back(std::polar(drive.wheel_rms * std::sqrt(2.0 * kLines / highest), 2.0 * M_PI * normal(random)));
    turns.push_back(std::polar(1.0, 2.0 * M_PI * f * h));
  }
  SampledStrut result{drive.rate, {}, {}};
  double travel = 0.0, rate = 0.0;
  for (int i = 0; i < drive.rate * drive.seconds; ++i) {
    double wheel = 0.0, sprung = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      wheel = 0.0;
      for (std::size_t j = 0; j < lines.size(); ++j) wheel += (lines[j] *= turns[j]).real();
      const double linear = drive.b1 * rate + drive.b0 * travel;
      sprung = linear + std::clamp(wheel - linear + rate / h, -friction, friction);  // it sticks by less
      rate += h * (wheel - sprung);
      travel += h * rate;
    }
    result.wheel.push_back(wheel + drive.wheel_noise * normal(random));
    result.body.push_back(sprung + drive.body_noise * normal(random));
  }
  return result;
}

TEST(BlocksOfAStrut, GiveTheStrutTheDelayAndTheTimeOfTheNewestBlock) {
  NoisyDrive drive;
  drive.delay = 0.003;
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
  const std::vector<TopEstimate> estimates = feed(blocks, readingsOf(drive.sample(), 1000.0));
  ASSERT_EQ(estimates.size(), 28u);  // blocks 2 to 29 of 0 to 29: the last reading is before 32 s
  const TopEstimate& last = estimates.back();
  EXPECT_EQ(last.stamp, fromSeconds(1031.0));
  EXPECT_NEAR(last.theta[0] / drive.b1, 1.0, 4.0 * last.relativeStddev(0));
  EXPECT_NEAR(last.theta[1] / drive.b0, 1.0, 4.0 * last.relativeStddev(1));
  EXPECT_NEAR(last.theta[kBlockDelay], drive.delay, 4.0 * std::sqrt(last.covariance(kBlockDelay, kBlockDelay)));
  EXPECT_LT(std::sqrt(last.covariance(kBlockDelay, kBlockDelay)), 5e-4);
  EXPECT_GT(last.explained, 0.99);
  EXPECT_EQ(last.length, 2.0);
  EXPECT_GE(last.age, 0.0);
  EXPECT_LE(last.age, 2.0);
}

TEST(BlocksOfAStrut, KnowTheStrutWhateverTheGainOfASensor) {
  for (const double gain : {0.8, 1.1, 1.25, 1.0 / kStandardGravity, kStandardGravity})
    for (const bool of_wheel : {false, true}) {
      NoisyDrive drive;
      auto sampled = drive.sample();
      for (double& value : of_wheel ? sampled.wheel : sampled.body) value *= gain;
      VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
      const TopEstimate last = feed(blocks, readingsOf(sampled)).back();
      EXPECT_NEAR(last.theta[0] / drive.b1, 1.0, 4.0 * last.relativeStddev(0)) << gain;
      EXPECT_NEAR(last.theta[1] / drive.b0, 1.0, 4.0 * last.relativeStddev(1)) << gain;
      const double expected = (of_wheel ? 1.0 / gain : gain) - 1.0;
      EXPECT_NEAR(last.theta[kBlockGain], expected, 4.0 * std::sqrt(last.covariance(kBlockGain, kBlockGain))) << gain;
    }
}

TEST(BlocksOfAStrut, SeeNoGainInASpringThatDependsOnFrequency) {
  for (const double stiffening : {0.1, 0.2, 0.5})
    for (const double relaxation : {0.02, 0.05, 0.1, 0.2, 0.5}) {
      NoisyDrive drive;
      drive.memory_spring = stiffening * drive.b0;
      drive.relaxation = relaxation;
      drive.seconds = 64.0;
      VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
      for (const TopEstimate& each : feed(blocks, readingsOf(drive.sample())))
        ASSERT_NEAR(each.theta[kBlockGain], 0.0, 1e-6) << stiffening << " " << relaxation;
    }
}

// d' = s w'' / A, white from the lowest bin on; what is below is little.
TEST(BlocksOfAStrut, GiveTheTravelRateOfTheStrut) {
  NoisyDrive drive;
  double mean_square = 0.0;
  constexpr double kStep = 0.01;
  for (double f = 0.75; f < drive.rate / 3.0; f += kStep) {
    const Complex s(0.0, 2.0 * M_PI * f);
    mean_square +=
        kStep * std::norm(s / (s * s + drive.b1 * s + drive.b0)) * std::pow(drive.wheel_rms, 2) / (drive.rate / 3.0);
  }
  double sum = 0.0, count = 0.0;
  for (drive.seed = 1; drive.seed <= 10; ++drive.seed) {
    VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
    for (const TopEstimate& each : feed(blocks, readingsOf(drive.sample()))) {
      sum += each.rate * each.rate;
      count += 1.0;
    }
  }
  // Of 10 drives, each some 30 values of the two bins about the bounce.
  EXPECT_NEAR(std::sqrt(sum / count / mean_square), 1.0, 0.1);
}

TEST(BlocksOfAStrut, DependOnNoUnit) {
  NoisyDrive drive;
  drive.rate = 200.0;
  drive.delay = 0.002;
  const SampledStrut sampled = withFriction(drive, 0.3);
  SampledStrut scaled{16.0 * sampled.rate, sampled.body, sampled.wheel};
  for (double& each : scaled.body) each *= 1000.0;
  for (double& each : scaled.wheel) each *= 1000.0;
  VehicleBlocks one(VehicleChannels::ofAccelerometers(), 1.0 / sampled.rate);
  VehicleBlocks other(VehicleChannels::ofAccelerometers(), 1.0 / scaled.rate, kBlockTuning.length / 16.0);
  const std::vector<TopEstimate> plain = feed(one, readingsOf(sampled)), turned = feed(other, readingsOf(scaled));
  ASSERT_EQ(plain.size(), turned.size());
  const double units[] = {16.0, 256.0, 1.0 / 16.0, 1.0, 1.0, 1000.0};
  for (std::size_t i = 0; i < plain.size(); ++i) {
    ASSERT_EQ(plain[i].blocks, turned[i].blocks) << i;
    EXPECT_NEAR(turned[i].explained, plain[i].explained, 1e-6);
    for (int j = 0; j < 6; ++j) {
      const double stddev = std::sqrt(plain[i].covariance(j, j));
      ASSERT_NEAR(turned[i].theta[j] / units[j], plain[i].theta[j], 1e-5 * stddev) << i << ", " << j;
      ASSERT_NEAR(std::sqrt(turned[i].covariance(j, j)) / units[j] / stddev, 1.0, 1e-5) << i << ", " << j;
    }
    ASSERT_NEAR(turned[i].rate / plain[i].rate, 1000.0 / 16.0, 1e-3);
    ASSERT_NEAR(turned[i].age * 16.0, plain[i].age, 1e-5);
  }
}

TEST(BlocksOfAStrut, MayGetTheWheelsReadingsInBurstsOfThreeSeconds) {
  const NoisyDrive drive;
  std::vector<VehicleReading> even = readingsOf(drive.sample()), bursts = even;
  std::stable_sort(bursts.begin() + 2, bursts.end(), [](const VehicleReading& a, const VehicleReading& b) {
    const auto time = [](const VehicleReading& r) {
      return r.sensor == Sensor::kSprung ? r.stamp : fromSeconds(3.0 * (1.0 + std::floor(toSeconds(r.stamp) / 3.0)));
    };
    return time(a) < time(b);
  });
  VehicleBlocks one(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate),
      other(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
  const std::vector<TopEstimate> first = feed(one, even);
  std::vector<TopEstimate> second;
  for (const VehicleReading& reading : bursts)
    if (const TopEstimate* estimate = other.push(reading)) second.push_back(*estimate);
  ASSERT_GE(second.size(), 8u);
  ASSERT_EQ(second.back().stamp, first.back().stamp);
  // The model of dry friction has a younger strut where readings come in time.
  for (const int i : {0, 1})
    EXPECT_NEAR(second.back().theta[i] / first.back().theta[i], 1.0, 0.2 * first.back().relativeStddev(i));
}

TEST(BlocksOfAStrut, AreTheSameWhicheverSensorOfAnInstantComesFirst) {
  const NoisyDrive drive;
  std::vector<VehicleReading> body_first = readingsOf(drive.sample()), wheel_first = body_first;
  for (std::size_t i = 0; i < wheel_first.size(); i += 2) std::swap(wheel_first[i], wheel_first[i + 1]);
  VehicleBlocks one(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate),
      other(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
  const std::vector<TopEstimate> first = feed(one, body_first), second = feed(other, wheel_first);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    for (const int j : {0, 1})
      EXPECT_NEAR(second[i].theta[j] / first[i].theta[j], 1.0, 0.02 * first[i].relativeStddev(j)) << i;
}

TEST(BlocksOfAStrut, SayNothingWhileOneSensorIsSilentAndGoOnAfterwards) {
  NoisyDrive drive;
  drive.seconds = 64.0;
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
  std::vector<VehicleReading> readings = readingsOf(drive.sample());
  const auto silent = [](const VehicleReading& reading) {
    const double t = toSeconds(reading.stamp);
    return reading.sensor == Sensor::kUnsprung && t > 20.3 && t < 44.2;
  };
  readings.erase(std::remove_if(readings.begin(), readings.end(), silent), readings.end());
  const std::vector<TopEstimate> estimates = feed(blocks, readings);
  // The last block ends at 20 s; the first of 45 s to 47 s. None of the time between, and none is left out else.
  ASSERT_EQ(estimates.size(), 17u + 17u);
  for (const TopEstimate& each : estimates) {
    EXPECT_TRUE(each.stamp <= fromSeconds(20.0) || each.stamp >= fromSeconds(47.0));
    EXPECT_NEAR(each.theta[0] / drive.b1, 1.0, 5.0 * each.relativeStddev(0));
  }

  VehicleBlocks deaf(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
  for (const VehicleReading& reading : readings)
    if (reading.sensor == Sensor::kSprung) {
      EXPECT_EQ(deaf.push(reading), nullptr);
    }
}

TEST(BlocksOfAStrut, SayNothingOfSensorsThatReadTooSeldom) {
  for (const double rate : {2.0, 1.0, 0.5}) {  // of a bounce of 1.15 Hz
    NoisyDrive drive;
    drive.rate = rate;
    VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / rate);
    EXPECT_TRUE(feed(blocks, readingsOf(drive.sample())).empty()) << rate << " Hz";
  }
}

TEST(BlocksOfAStrut, GoOnAfterAClockThatWentBackOnceTheyAreRestarted) {
  NoisyDrive drive;
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
  feed(blocks, readingsOf(drive.sample(), 5000.0));
  ASSERT_NE(blocks.estimate(), nullptr);
  blocks.restart();
  EXPECT_EQ(blocks.estimate(), nullptr);
  drive.seed = 2;
  const std::vector<TopEstimate> after = feed(blocks, readingsOf(drive.sample(), 17.0));
  ASSERT_EQ(after.size(), 28u);
  EXPECT_EQ(after.front().stamp, fromSeconds(21.0));
  for (const TopEstimate& each : after) EXPECT_NEAR(each.theta[1] / drive.b0, 1.0, 5.0 * each.relativeStddev(1));
}

TEST(BlocksOfAStrut, FollowTheBounceWithTheirLength) {
  for (const auto& [b0, length] : {std::pair(12.0, 4.0), std::pair(52.0, 2.0), std::pair(900.0, 1.0)}) {
    NoisyDrive drive;
    drive.b0 = b0;
    drive.b1 = 0.5 * std::sqrt(b0);
    drive.rate = 128.0;
    drive.seconds = 64.0;
    VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
    feed(blocks, readingsOf(drive.sample()));
    ASSERT_NE(blocks.estimate(), nullptr);
    EXPECT_EQ(blocks.estimate()->length, length) << b0;
    EXPECT_NEAR(blocks.estimate()->theta[1] / b0, 1.0, 5.0 * blocks.estimate()->relativeStddev(1)) << b0;
  }
}

TEST(BlocksOfAStrut, KnowTheDriveByTheBlocksThatAreMostOfItThoughTheirLengthChangesAtItsEnd) {
  NoisyDrive drive;
  drive.rate = 128.0;
  drive.seconds = 60.0;
  NoisyDrive soft = drive;  // bounces so slowly that blocks of twice the length follow
  soft.b0 = 12.0;
  soft.b1 = 0.5 * std::sqrt(soft.b0);
  soft.seconds = 20.0;
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
  feed(blocks, readingsOf(drive.sample()));
  const double first_length = blocks.estimator().equations().band().length;
  const std::optional<TopEstimate> before = blocks.overTheDrive();
  for (const VehicleReading& reading : readingsOf(soft.sample(), drive.seconds)) {
    blocks.push(reading);
    if (blocks.estimator().equations().band().length != first_length) break;
  }
  ASSERT_NE(blocks.estimator().equations().band().length, first_length);
  const std::optional<TopEstimate> after = blocks.overTheDrive();
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->length, first_length);
  EXPECT_GE(after->blocks, before->blocks);
  EXPECT_NEAR(after->theta[1] / drive.b0, 1.0, 0.1);
}

TEST(BlocksOfAStrut, NeedNeitherCommonNorEvenStampsOfTheSensors) {
  const double b1 = 4.2, b0 = 52.0;
  Exponentials wheel;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  for (double f = 0.33; f < 20.0; f += 0.33) wheel.addSine(0.5, f, 2.0 * M_PI * uniform(random));
  const Exponentials body = wheel.throughStrut(b1, b0);
  std::vector<VehicleReading> readings;
  for (double t = 0.0; t < 40.0; t += 0.01 * (0.4 + 1.2 * uniform(random))) {
    const Stamp stamp = fromSeconds(t);
    readings.push_back(readingOf(Side::kSprung, stamp, 9.81 + body.at(toSeconds(stamp))));
  }
  for (double t = 0.003; t < 40.0; t += 0.006 * (0.7 + 0.6 * uniform(random))) {
    const Stamp stamp = fromSeconds(t);
    if (uniform(random) > 0.05)
      readings.push_back(readingOf(Side::kUnsprung, stamp, -1.0 + wheel.at(toSeconds(stamp))));
  }
  std::stable_sort(readings.begin(), readings.end(),
                   [](const VehicleReading& a, const VehicleReading& b) { return a.stamp < b.stamp; });
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 0.01);
  feed(blocks, readings);
  const std::optional<TopEstimate> found = blocks.overTheDrive();
  ASSERT_TRUE(found);
  const WindowEstimate& all = *found;
  EXPECT_GT(all.blocks, 30);
  EXPECT_NEAR(all.theta[0] / b1, 1.0, std::min(0.02, 4.0 * all.relativeStddev(0)));
  EXPECT_NEAR(all.theta[1] / b0, 1.0, std::min(0.02, 4.0 * all.relativeStddev(1)));
}

TEST(BlocksOfAStrut, RecoverCoulombsFrictionWithinATenth) {
  for (const double friction : {0.2, 0.6}) {
    NoisyDrive drive;
    drive.rate = 100.0;
    drive.seconds = 64.0;
    VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), 1.0 / drive.rate);
    feed(blocks, readingsOf(withFriction(drive, friction)));
    const std::optional<TopEstimate> found = blocks.overTheDrive();
    ASSERT_TRUE(found);
    const WindowEstimate& all = *found;
    EXPECT_NEAR(all.theta[kNumBlockParameters], friction, 0.1 * friction);
    // Of 0.6 m/s^2 a strut without friction explains two thirds; what is left by the law moves b1 by some 8 %.
    const double law = friction < 0.3 ? 0.03 : 0.15;
    EXPECT_NEAR(all.theta[0] / drive.b1, 1.0, law);
    EXPECT_NEAR(all.theta[1] / drive.b0, 1.0, law);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
