#include "suspension_health_monitor/internal/signal/regular_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.003;  // [s]
constexpr int kReadings = 6000, kSettled = 3000;

/// By how many periods the stamp of reading k is late.
using Delay = std::function<double(int k, std::mt19937_64& random)>;

/// @return by how much next() is off the regular times, but for its mean; periods.
double follow(const Delay& delay, double lost, int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::uniform_real_distribution<double> uniform;
  RegularTimes times;
  double last = -1.0, sum = 0.0, square = 0.0, count = 0.0;
  for (int k = 0; k < kReadings; ++k) {
    const double regular = k * kPeriod, stamp = std::max(regular + kPeriod * delay(k, random), last + 1e-6);
    if (uniform(random) < lost) continue;
    const double off = times.next(last = stamp) - regular;
    if (k < kSettled) continue;
    sum += off;
    square += off * off;
    count += 1.0;
  }
  const double variance = std::max(0.0, square / count - std::pow(sum / count, 2));
  return std::sqrt(variance) / kPeriod;
}

Delay uniformUpTo(double most) {
  return [most](int, std::mt19937_64& random) { return std::uniform_real_distribution<double>(0.0, most)(random); };
}

// Every so often a message waits for 5 to 10 periods, and those behind it with it.
Delay queueThatWaits(double share) {
  return [share, wait = 0.0](int, std::mt19937_64& random) mutable {
    std::uniform_real_distribution<double> uniform;
    wait = std::max(0.0, wait - 1.0);
    if (uniform(random) < share) wait = 5.0 + 5.0 * uniform(random);
    return wait + 0.05 * uniform(random);
  };
}

// Least squares of the newest 1000 leave 2 / sqrt(1000) of a distance's standard deviation, here that of a uniform one;
// a quarter more is four standard deviations of what a stretch of three memories has.
TEST(RegularTimes, AreALineThroughTheStamps) {
  for (const double most : {0.1, 0.5, 0.9})
    for (int seed = 1; seed <= 10; ++seed) {
      const double off = follow(uniformUpTo(most), 0.0, seed);
      EXPECT_LT(off, 1.25 * 2.0 / std::sqrt(1000.0) * most / std::sqrt(12.0)) << most << ' ' << seed;
    }
}

TEST(RegularTimes, CountLostReadingsBetweenLateStamps) {
  for (const double most : {0.1, 0.3, 0.5, 0.6})
    for (const double lost : {0.02, 0.05})
      for (int seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(std::to_string(most) + ", " + std::to_string(lost) + ", " + std::to_string(seed));
        EXPECT_LT(follow(uniformUpTo(most), lost, seed), 0.1);
      }
}

TEST(RegularTimes, AreNotMovedByMessagesThatWaited) {
  double square = 0.0;
  for (int seed = 1; seed <= 20; ++seed) square += std::pow(follow(queueThatWaits(0.005), 0.0, seed), 2) / 20.0;
  EXPECT_LT(std::sqrt(square), 0.15);  // the stamps are off by 1.1
}

TEST(RegularTimes, OfBatchesAreAsGoodAsOfSingleMessages) {
  const auto in_batches = [](int k, std::mt19937_64&) { return 3.0 - 0.99 * (k % 4); };
  EXPECT_LT(follow(in_batches, 0.0, 1), 0.02);  // the stamps are off by 1.1
}

}  // namespace
}  // namespace suspension_health_monitor
