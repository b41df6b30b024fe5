#include "suspension_health_monitor/internal/signal/stream_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;  // [s]

double signal(double t) { return std::sin(2.0 * M_PI * 4.0 * t) + 0.5 * std::sin(2.0 * M_PI * 11.0 * t); }

/// As fast as filters let it be: as strong at all frequencies up to 0.4 of the rate.
double fastSignal(double t) {
  double sum = 0.0;
  for (int i = 1; i <= 40; ++i) sum += std::sin(2.0 * M_PI * 0.987 * i * t + i * i);
  return sum;
}

/// By how many periods the stamp of reading k is late.
using Delay = std::function<double(int k, std::mt19937_64& random)>;

/// How a stream is taken, off the regular time by chance (standard deviation, in periods), stamped and lost.
struct Way {
  double taken = 0.0;
  Delay stamped = [](int, std::mt19937_64&) { return 0.0; };
  double lost = 0.0;
  double (*signal)(double) = suspension_health_monitor::signal;
};

Delay byChance(double deviation) {
  return [deviation](int, std::mt19937_64& random) { return std::normal_distribution<double>(0.0, deviation)(random); };
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

struct Found {
  double off = 0.0;      // standard deviation of the times returned about the true ones, in periods
  double stamps = 0.0;   // of the stamps, likewise
  double nearest = 1e9;  // two times returned, in periods
};

Found run(const Way& way, int seed = 7, int readings = 20000) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  StreamClock clock;
  Found found;
  double sum = 0.0, squares = 0.0, stamp_squares = 0.0, count = 0.0, before = 0.0;
  Stamp last{};
  for (int k = 1; k <= readings; ++k) {
    const double taken = kPeriod * (k + way.taken * normal(random));
    Stamp stamp = fromSeconds(taken + kPeriod * way.stamped(k, random));
    const double value = way.signal(taken) + 0.01 * normal(random);
    if (uniform(random) < way.lost) continue;
    if (stamp <= last) {
      clock.passOver();
      continue;
    }
    last = stamp;
    const double time = toSeconds(clock.add(stamp, value));
    if (k > readings / 2) {
      const double off = (time - taken) / kPeriod;
      sum += off;
      squares += off * off;
      stamp_squares += std::pow((toSeconds(stamp) - taken) / kPeriod, 2);
      count += 1.0;
      found.nearest = std::min(found.nearest, (time - before) / kPeriod);
    }
    before = time;
  }
  found.off = std::sqrt(std::max(0.0, squares / count - sum * sum / count / count));
  found.stamps = std::sqrt(stamp_squares / count);
  return found;
}

// Least squares of the newest 1000 leave 2 / sqrt(1000) of a stamp's standard deviation.
TEST(StreamClock, KnowsWhenRegularReadingsWithIrregularStampsWereTaken) {
  for (const double stamped : {0.02, 0.1, 0.2, 0.3})
    for (int seed = 1; seed <= 5; ++seed) {
      const Found found = run({0.0, byChance(stamped)}, seed);
      EXPECT_LT(found.off, 0.15 * std::max(0.05, found.stamps)) << stamped << ' ' << seed;
      EXPECT_GT(found.nearest, 0.45) << stamped << ' ' << seed;  // no curve through the readings is torn
    }
}

TEST(StreamClock, TakesReadingsThatAreTakenIrregularlyAtTheirStamps) {
  for (const double taken : {0.02, 0.1, 0.2, 0.3}) EXPECT_LT(run({taken}).off, 1e-6) << taken;  // nanoseconds
}

// Of such motion a derivative by two readings shows little, but enough.
TEST(StreamClock, KnowsByHalfAMinuteOfFastMotionWhenReadingsWereTaken) {
  constexpr int kReadings = 3000;
  const Delay late = [](int, std::mt19937_64& random) { return std::uniform_real_distribution<>(0.0, 0.5)(random); };
  for (int seed = 1; seed <= 5; ++seed) {
    const Found regular = run({0.0, late, 0.0, fastSignal}, seed, kReadings);
    EXPECT_LT(regular.off, 0.15 * 0.5 / std::sqrt(12.0)) << seed;
    EXPECT_LT(run({0.1, byChance(0.0), 0.0, fastSignal}, seed, kReadings).off, 1e-6) << seed;
  }
}

TEST(StreamClock, CountsLostReadingsBetweenIrregularStamps) {
  for (const double stamped : {0.0, 0.05, 0.1, 0.2})
    for (const double lost : {0.002, 0.01, 0.05})
      for (int seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(std::to_string(stamped) + ", " + std::to_string(lost) + ", " + std::to_string(seed));
        EXPECT_LT(run({0.0, byChance(stamped), lost}, seed).off, 0.05 + 4.0 * lost);
      }
}

TEST(StreamClock, KnowsWhenTheReadingAfterSeveralLostOnesWasTaken) {
  for (int lost : {1, 2, 3, 4}) {
    StreamClock clock;
    for (int k = 1; k <= 3000; ++k) {
      const int place = k % 50;
      // One more reading is lost behind the first one that comes again.
      if (k > 1000 && (place < lost || place == lost + 1)) continue;
      const double taken = kPeriod * k;
      EXPECT_NEAR(toSeconds(clock.add(fromSeconds(taken), signal(taken))), taken, 0.01 * kPeriod) << lost << ' ' << k;
    }
  }
}

TEST(StreamClock, IsNotMovedByMessagesThatWaited) {
  double squares = 0.0, stamps = 0.0;
  for (int seed = 1; seed <= 10; ++seed) {
    const Found found = run({0.0, queueThatWaits(0.005)}, seed);
    squares += found.off * found.off / 10.0;
    stamps += found.stamps * found.stamps / 10.0;
  }
  EXPECT_GT(std::sqrt(stamps), 0.7);
  EXPECT_LT(std::sqrt(squares), 0.2);
}

TEST(StreamClock, OfBatchesIsAsGoodAsOfSingleMessages) {
  const Found found = run({0.0, [](int k, std::mt19937_64&) { return 3.0 - 0.99 * (k % 4); }});
  EXPECT_GT(found.stamps, 1.0);
  EXPECT_LT(found.off, 0.05);
}

// Of a signal at rest nobody knows: stamps are used as they are.
TEST(StreamClock, UsesTheStampsOfASignalAtRest) {
  StreamClock clock;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int k = 1; k <= 5000; ++k) {
    const Stamp stamp = fromSeconds(kPeriod * (k + 0.1 * normal(random)));
    EXPECT_EQ(clock.add(stamp, 9.81), stamp);
  }
}

TEST(StreamClock, GoesForwardAndBeginsAnew) {
  StreamClock clock;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Stamp last{};
  for (const double begin : {1.0, 500.0, 20.0}) {
    if (begin < toSeconds(last)) {
      clock.interrupt();
      last = Stamp{};
    }
    for (int k = 1; k <= 4000; ++k) {
      const double taken = begin + kPeriod * k;
      const Stamp found = clock.add(fromSeconds(taken + 0.1 * kPeriod * normal(random)), signal(taken));
      EXPECT_GT(found, last);
      last = found;
    }
    EXPECT_NEAR(toSeconds(last), begin + 4000 * kPeriod, 0.03 * kPeriod) << begin;
  }
}

// Readings that come half as often, or twice, are not lost ones for long.
TEST(StreamClock, FollowsAnotherRate) {
  for (const double factor : {0.5, 0.8, 1.25, 2.0}) {
    StreamClock clock;
    double t = 0.0, spacing = kPeriod;
    Stamp found{};
    for (int k = 0; k < 8000; ++k) {
      if (k == 4000) spacing *= factor;
      t += spacing;
      found = clock.add(fromSeconds(t), signal(t));
    }
    EXPECT_NEAR(toSeconds(found), t, 1e-6) << factor;
    EXPECT_NEAR(clock.period(), spacing, 1e-6) << factor;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
