#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;
constexpr int kSamples = 400;
constexpr std::size_t kFirst = kInterpolationReach;  // sample of the drive that a segment begins with
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

DriveRecord makeRecord(const std::vector<BodyMotion>& motion = {}) {
  Drive record_drive;
  for (int k = 0; k < kSamples; ++k)
    record_drive.samples.push_back({fromSeconds(5.0 + k * kPeriod), std::sin(0.3 * k), std::cos(0.2 * k)});
  record_drive.body = motion;
  const DriveRecord record(record_drive, kPeriod, 1);
  return record;
}

/// @param at  t [s] since the first sample -> what the IMU measures across the strut.
template <class At>
DriveRecord withBody(const At& at, double period = kPeriod) {
  std::vector<BodyMotion> motion;
  for (double t = 0.0; t < kSamples * kPeriod; t += period) {
    motion.push_back(at(t));
    motion.back().stamp = fromSeconds(5.0 + t);
  }
  return makeRecord(motion);
}

const std::vector<double>& channel(const DriveRecord& record, BodyChannel which) {
  return record.segments().at(0).body[static_cast<std::size_t>(which)];
}

double timeOf(std::size_t k) { return static_cast<double>(k + kFirst) * kPeriod; }

std::vector<std::string> untestable(const DriveRecord& record) {
  EffectLibrary library = builtInEffects();
  const std::size_t all = library.readings.size();
  std::vector<std::string> names;
  for (const auto& [name, missing] : takeUntestable(library, {&record})) names.push_back(name);
  EXPECT_EQ(library.readings.size() + names.size(), all);
  return names;
}

TEST(BodyMotion, AccelerationsComeToTheSamplesWithoutTheirMean) {
  // Messages at a third of the rate: a straight line between them is what a ramp is.
  const DriveRecord record = withBody([](double t) { return BodyMotion{{}, {3.0 + 2.0 * t, -t}, {}}; }, 3 * kPeriod);
  const std::vector<double>& x = channel(record, BodyChannel::kAccelerationX);
  const std::vector<double>& y = channel(record, BodyChannel::kAccelerationY);
  ASSERT_EQ(x.size(), record.segments()[0].size());
  const double mean_time = 1.995;  // of messages at 0, 0.03 .. 3.99 s
  for (std::size_t k = 0; k < x.size(); ++k) {
    EXPECT_NEAR(x[k], 2.0 * (timeOf(k) - mean_time), 1e-9);
    EXPECT_NEAR(y[k], -(timeOf(k) - mean_time), 1e-9);
  }
}

TEST(BodyMotion, AngularAccelerationIsTheRatesDerivative) {
  const DriveRecord record = withBody([](double t) {
    return BodyMotion{{}, {}, {std::sin(5.0 * t), 0.2 * std::cos(8.0 * t)}};
  });
  const std::vector<double>& x = channel(record, BodyChannel::kAngularAccelerationX);
  const std::vector<double>& y = channel(record, BodyChannel::kAngularAccelerationY);
  ASSERT_EQ(x.size(), record.segments()[0].size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    EXPECT_NEAR(x[k], 5.0 * std::cos(5.0 * timeOf(k)), 1e-4);
    EXPECT_NEAR(y[k], -1.6 * std::sin(8.0 * timeOf(k)), 1e-4);
  }
}

TEST(BodyMotion, NoiseOfTheRateIsSmoothedAway) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.002);
  const DriveRecord record = withBody([&](double t) {
    return BodyMotion{{}, {}, {0.1 * std::sin(8.0 * t) + noise(random), noise(random)}};
  });
  const std::vector<double>& x = channel(record, BodyChannel::kAngularAccelerationX);
  double square = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) square += std::pow(x[k] - 0.8 * std::cos(8.0 * timeOf(k)), 2);
  // Between neighbours the difference alone would leave 0.002 / (sqrt(2) T) = 0.14.
  EXPECT_LT(std::sqrt(square / static_cast<double>(x.size())), 0.03);
}

TEST(BodyMotion, WhatIsNotMeasuredOrStandsStillIsEmptyAndItsEffectsUntestable) {
  const auto moving = [](double t) { return BodyMotion{{}, {std::sin(t), std::cos(t)}, {std::sin(t), std::cos(t)}}; };
  EXPECT_TRUE(untestable(withBody(moving)).empty());
  EXPECT_EQ(untestable(makeRecord()), (std::vector<std::string>{"mount_tilt", "lever_arm"}));
  const DriveRecord no_gyro = withBody([&](double t) {
    BodyMotion motion = moving(t);
    motion.angular_rate = {kNone, kNone};
    return motion;
  });
  EXPECT_EQ(untestable(no_gyro), std::vector<std::string>{"lever_arm"});
  EXPECT_TRUE(channel(no_gyro, BodyChannel::kAngularAccelerationX).empty());
  const DriveRecord planar = withBody([&](double t) {
    BodyMotion motion = moving(t);
    motion.acceleration[1] = 0.3;
    return motion;
  });
  EXPECT_TRUE(untestable(planar).empty());  // one axis is enough
  EXPECT_TRUE(channel(planar, BodyChannel::kAccelerationY).empty());
  const DriveRecord parked = withBody([&](double t) {
    BodyMotion motion = moving(t);
    motion.acceleration = {0.1, 0.3};
    return motion;
  });
  EXPECT_EQ(untestable(parked), std::vector<std::string>{"mount_tilt"});
}

TEST(SlopeWeights, AreExactForAQuarticAndHaveTheNoiseThatTheySay) {
  for (const int half_width : {2, 4, 8, 12}) {
    const Eigen::VectorXd weights = slopeWeights(half_width, 0.5);
    std::vector<double> values;
    for (int k = -half_width; k <= half_width; ++k) {
      const double t = 0.5 * k;
      values.push_back(7.0 - 3.0 * t + 2.0 * t * t + 0.5 * t * t * t - 0.25 * t * t * t * t);
    }
    EXPECT_NEAR(weightedSlope(&values[static_cast<std::size_t>(half_width)], weights), -3.0, 1e-9) << half_width;
    double gain = 0.0;  // from the answers to single ones
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::vector<double> one(values.size(), 0.0);
      one[i] = 1.0;
      gain += std::pow(weightedSlope(&one[static_cast<std::size_t>(half_width)], weights), 2);
    }
    EXPECT_NEAR(noiseOfSlope(weights), std::sqrt(gain), 1e-12);
  }
}

TEST(SlopeWeights, AreWideOnlyWhereTheSeriesIsNoisy) {
  std::mt19937 random(1);
  std::normal_distribution<double> gaussian;
  const auto halfWidth = [&](double noise) {
    std::vector<double> series;
    for (int k = 0; k < 2000; ++k) series.push_back(std::sin(0.1 * k) + noise * gaussian(random));
    return fittingSlope({series}, 0.01).size();
  };
  EXPECT_EQ(halfWidth(0.0), 2);
  EXPECT_EQ(halfWidth(0.004), 4);  // noise gains 0.95, 0.34, 0.12 / T; the slope's rms is 0.071 / T
  EXPECT_EQ(halfWidth(0.015), 8);
  EXPECT_EQ(halfWidth(0.2), kWidestSlope);
}

}  // namespace
}  // namespace suspension_health_monitor
