#include "suspension_health_monitor/internal/signal/stream_resampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.005;  // of the grid [s]
constexpr double kNyquist = 0.5 / kPeriod;
constexpr int kCount = 600;  // instants of the grid

/// How a sensor reads.
struct Sampling {
  double rate = 200.0;    // [Hz]
  double phase = 0.0013;  // [s]
  double jitter = 0.0;    // readings are late by 0..jitter [s], and stamped so
  double lost = 0.0;      // share
};

std::vector<double> timesOf(const Sampling& sampling, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> times;
  for (int k = 0; k / sampling.rate < kPeriod * (kCount + 80); ++k) {
    const double t = k / sampling.rate + sampling.phase + sampling.jitter * uniform(engine);
    if (uniform(engine) >= sampling.lost) times.push_back(t);
  }
  return times;
}

/// Values at grid instants 10 .. kCount + 9.
std::vector<double> resampled(const std::vector<double>& times, const std::function<double(double)>& signal,
                              Stamp start = {}) {
  StreamResampler stream(fromSeconds(kPeriod));
  ReadingQueue readings(kMostWaiting);
  const double stream_period = (times.back() - times.front()) / static_cast<double>(times.size());
  for (const double t : times) {
    const Stamp stamp = fromSeconds(t);  // whole nanoseconds
    readings.push_back({start + stamp, start + stamp, signal(toSeconds(stamp)), false, stream_period});
  }
  std::vector<double> values;
  for (int k = 10; k < kCount + 10; ++k) {
    const Stamp t = start + k * fromSeconds(kPeriod);
    EXPECT_EQ(stream.advance(t, readings), StreamResampler::Coverage::kCovered) << k;
    values.push_back(stream.at(t).value);
  }
  return values;
}

/// Largest deviation of the values from `expected` at their instants.
double worst(const std::vector<double>& values, const std::function<double(double)>& expected) {
  double error = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    error = std::max(error, std::abs(values[i] - expected(kPeriod * static_cast<double>(i + 10))));
  return error;
}

std::function<double(double)> sine(double frequency) {
  return [frequency](double t) { return std::sin(2.0 * M_PI * frequency * t + 0.3); };
}

const std::vector<Sampling> kSamplings{
    {200.0, 0.0, 0.0, 0.0},      {200.0, 0.0013, 0.0, 0.0}, {333.0, 0.0007, 0.0, 0.0},    {200.0, 0.0, 0.001, 0.0},
    {333.0, 0.0007, 0.001, 0.0}, {200.0, 0.0, 0.001, 0.02}, {333.0, 0.0007, 0.001, 0.02}, {1000.0, 0.0, 0.0009, 0.02}};

TEST(StreamResampler, PassesAConstantExactly) {
  for (const Sampling& sampling : kSamplings)
    EXPECT_EQ(worst(resampled(timesOf(sampling, 1), [](double) { return 9.81; }), [](double) { return 9.81; }), 0.0);
}

// Within the window of +-40 ms a cubic of the size of gravity is a sum of slow sinusoids, which pass to 1e-3.
TEST(StreamResampler, PassesSlowTrendsOnTheirInstants) {
  const auto cubic = [](double t) {
    const double s = t - 1.5;
    return 9.81 + 2.0 * s - 3.0 * s * s + s * s * s;
  };
  for (const Sampling& sampling : kSamplings)
    EXPECT_LT(worst(resampled(timesOf(sampling, 2), cubic), cubic), 1e-3) << sampling.rate << " " << sampling.lost;
}

// The ripple of the filter, and the image of a quintic spline through as many readings as the grid has instants:
// (f / (1 - f))^6 of the amplitude, with f the frequency in cycles per reading.
TEST(StreamResampler, GivesSinesWithTheirAmplitudeAndPhaseWithoutAndWithJitter) {
  for (const Sampling& sampling : kSamplings) {
    if (sampling.lost > 0.0) continue;
    for (const double frequency : {1.0, 3.0, 7.0, 12.0, 20.0, 25.0, 35.0, 45.0, 58.0}) {
      const double error = worst(resampled(timesOf(sampling, 3), sine(frequency)), sine(frequency));
      EXPECT_LT(error, sampling.jitter == 0.0 ? 4e-3 : 8e-3) << sampling.rate << " Hz, " << frequency;
    }
  }
}

// Next to a lost reading the others are 2 T apart, and half as fast a sine is at their Nyquist frequency.
TEST(StreamResampler, GivesSinesWithTheirAmplitudeAndPhaseWhereReadingsAreLost) {
  for (const Sampling& sampling : kSamplings) {
    if (sampling.lost == 0.0) continue;
    for (const double frequency : {1.0, 3.0, 7.0, 12.0, 20.0, 25.0, 35.0, 45.0, 58.0}) {
      const double share = frequency / (0.6 * kNyquist);
      const std::vector<double> values = resampled(timesOf(sampling, 3), sine(frequency));
      double sum = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i)
        sum += std::pow(values[i] - sine(frequency)(kPeriod * static_cast<double>(i + 10)), 2);
      EXPECT_LT(std::sqrt(sum / kCount), 3e-3 + 0.1 * std::pow(share, 4)) << sampling.rate << " Hz, " << frequency;
    }
  }
}

// But for the image of the slower one, see above.
TEST(StreamResampler, GivesTwoStreamsOfDifferentRateTheSameAmplitudeAndPhase) {
  const auto response = [](const Sampling& sampling, double frequency) {
    const std::vector<double> values = resampled(timesOf(sampling, 4), sine(frequency));
    std::complex<double> sum;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum +=
          2.0 / kCount * values[i] * std::polar(1.0, -2.0 * M_PI * frequency * kPeriod * static_cast<double>(i + 10));
    return sum;
  };
  for (const double frequency : {2.0, 10.0, 25.0, 40.0, 60.0}) {  // whole numbers of periods in kCount
    const std::complex<double> slow = response({200.0, 0.0013, 0.0, 0.0}, frequency);
    const std::complex<double> fast = response({333.0, 0.0002, 0.0, 0.0}, frequency);
    const double cycles = frequency / 200.0;
    EXPECT_NEAR(std::abs(slow), 1.0, 3e-3) << frequency;
    EXPECT_LT(std::abs(slow - fast), 5e-5 + std::pow(cycles / (1.0 - cycles), 6)) << frequency;
  }
}

TEST(StreamResampler, KeepsOutWhatTheGridWouldFold) {
  for (const double frequency : {121.0, 135.0, 160.0, 190.0, 300.0, 420.0}) {
    const Sampling fast{1000.0, 0.0, 0.0, 0.0};
    EXPECT_LT(worst(resampled(timesOf(fast, 5), sine(frequency)), [](double) { return 0.0; }), 0.01) << frequency;
  }
}

TEST(StreamResampler, DependsOnlyOnTheTimeBetweenStamps) {
  const std::vector<double> times = timesOf({333.0, 0.0007, 0.001, 0.02}, 6);
  EXPECT_EQ(resampled(times, sine(11.0)), resampled(times, sine(11.0), std::chrono::hours(24 * 365 * 55)));
}

TEST(StreamResampler, IsLinearInTheReadings) {
  const std::vector<double> times = timesOf({200.0, 0.0, 0.001, 0.05}, 7);
  const std::vector<double> a = resampled(times, sine(4.0)), b = resampled(times, sine(31.0));
  const std::vector<double> both =
      resampled(times, [](double t) { return 2.0 * sine(4.0)(t) - 3.0 * sine(31.0)(t) + 5.0; });
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(both[i], 2.0 * a[i] - 3.0 * b[i] + 5.0, 1e-11);
}

// White noise stays white as far as the strut answers, to 0.6 of the Nyquist frequency, and the grid's share of the
// stream's band in all is lower by what the filter takes of the rest: half of the amplitude at the Nyquist frequency.
TEST(StreamResampler, LowersNoiseByTheShareOfTheBandThatItKeeps) {
  constexpr int kRuns = 10;
  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal;
  for (const Sampling& sampling : kSamplings) {
    double sum = 0.0, low = 0.0;
    for (unsigned run = 0; run < kRuns; ++run) {
      const std::vector<double> values = resampled(timesOf(sampling, run), [&](double) { return normal(engine); });
      for (const double value : values) sum += value * value / (kRuns * kCount);
      for (int line = 3; line < 180; line += 3) {  // of 300 up to the Nyquist frequency
        std::complex<double> component;
        for (int i = 0; i < kCount; ++i)
          component += values[static_cast<std::size_t>(i)] * std::polar(1.0, -2.0 * M_PI * line * i / kCount);
        low += std::norm(component) / (kRuns * kCount * 59);
      }
    }
    const double share = 200.0 / sampling.rate;
    EXPECT_NEAR(low / share, 1.0, 4.0 / std::sqrt(59 * kRuns)) << sampling.rate;
    EXPECT_GT(sum, 0.87 * share) << sampling.rate;
    EXPECT_LT(sum, (sampling.lost > 0.0 ? 1.15 : 1.05) * share) << sampling.rate;
  }
}

// Where readings are regular the error is no larger than without any loss: 4e-3 of each of the three sines.
TEST(StreamResampler, PredictsLostReadingsOfFastMotion) {
  const auto motion = [](double t) { return sine(7.0)(t) + sine(25.0)(t) + sine(58.0)(t); };
  std::vector<double> values = resampled(timesOf({200.0, 0.0013, 0.0, 0.02}, 3), motion);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= motion(kPeriod * static_cast<double>(i + 10));
  const std::size_t learnt = 200;
  for (std::size_t i = learnt; i < values.size(); ++i) EXPECT_LT(std::abs(values[i]), 3 * 4e-3) << i;
}

TEST(StreamResampler, BridgesThreeLostReadingsWithoutMakingNoiseOfThem) {
  std::mt19937_64 engine(9);
  std::normal_distribution<double> normal;
  std::vector<double> times = timesOf({200.0, 0.0, 0.0, 0.0}, 9);
  times.erase(times.begin() + 300, times.begin() + 303);
  EXPECT_LT(worst(resampled(times, sine(3.0)), sine(3.0)), 0.02);
  double most = 0.0;
  for (int run = 0; run < 100; ++run)
    most += std::pow(resampled(times, [&](double) { return normal(engine); })[301 - 10], 2) / 100;
  EXPECT_LT(most, 20.0);
}

TEST(StreamResampler, ReadsAStreamSlowerThanTheGrid) {
  for (const double rate : {90.0, 50.0, 9.0}) {  // the slowest is interpolated on a straight line
    const Sampling slow{rate, 0.0, 0.0, 0.0};
    const double share = 0.3 / rate;  // of the rate
    const auto signal = sine(rate * share);
    EXPECT_LT(worst(resampled(timesOf(slow, 10), signal), signal), 0.03) << rate;
  }
}

TEST(StreamResampler, TellsWhatItCovers) {
  using Coverage = StreamResampler::Coverage;
  const auto at = [](int k) { return k * fromSeconds(kPeriod); };
  StreamResampler stream(at(1));
  ReadingQueue readings(kMostWaiting);
  const auto push = [&](int k, bool still = false) { readings.push_back({at(k), at(k), 1.0, still, kPeriod}); };
  EXPECT_EQ(stream.advance(at(0), readings), Coverage::kComes);
  EXPECT_FALSE(stream.earliest(readings));
  for (int k = 0; k <= 20; ++k) push(k);
  EXPECT_EQ(*stream.earliest(readings), at(8));
  EXPECT_EQ(stream.advance(at(7), readings), Coverage::kInterrupted);
  EXPECT_EQ(stream.advance(at(8), readings), Coverage::kCovered);
  EXPECT_EQ(stream.advance(at(12), readings), Coverage::kCovered);
  EXPECT_EQ(stream.advance(at(13), readings), Coverage::kComes);
  push(30);
  EXPECT_EQ(stream.advance(at(13), readings), Coverage::kInterrupted);
  EXPECT_EQ(*stream.earliest(readings), at(38));
  for (int k = 31; k <= 46; ++k) push(k, k == 38);
  EXPECT_EQ(stream.advance(at(38), readings), Coverage::kCovered);
  EXPECT_TRUE(stream.at(at(38)).still);
  push(47);
  EXPECT_EQ(stream.advance(at(39), readings), Coverage::kCovered);
  EXPECT_FALSE(stream.at(at(39)).still);
}

}  // namespace
}  // namespace suspension_health_monitor
