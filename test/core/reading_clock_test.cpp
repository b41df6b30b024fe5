#include "suspension_health_monitor/internal/signal/reading_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;

double signal(double t) { return std::sin(2.0 * M_PI * 4.0 * t) + 0.5 * std::sin(2.0 * M_PI * 11.0 * t); }

/// How a stream is taken and stamped, each off the regular time by chance (standard deviation, in periods).
struct Way {
  double taken = 0.0, stamped = 0.0;
  double noise = 0.01;
  double lost = 0.0;
};

struct Times {
  double off = 0.0;     // root mean square of what take() is off by, but for its mean, in periods
  double stamps = 0.0;  // what stamps are off by, likewise
  double share = 0.0;
};

Times run(const Way& way, int readings = 20000) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  ReadingClock clock;
  double sum = 0.0, square = 0.0, stamps = 0.0, count = 0.0;
  Stamp last{};
  for (int k = 1; k <= readings; ++k) {
    const double taken = kPeriod * (k + way.taken * normal(random));
    const double stamped = taken + kPeriod * way.stamped * normal(random);
    const double value = signal(taken) + way.noise * normal(random);
    if (uniform(random) < way.lost) continue;
    if (fromSeconds(stamped) <= last) {
      clock.passOver(fromSeconds(stamped));
      continue;
    }
    last = fromSeconds(stamped);
    const double off = toSeconds(clock.take(last, value)) - taken;
    if (k < readings / 2) continue;
    sum += off;
    square += off * off;
    stamps += (stamped - taken) * (stamped - taken);
    count += 1.0;
  }
  return {std::sqrt(square / count - sum * sum / count / count) / kPeriod, std::sqrt(stamps / count) / kPeriod,
          clock.share()};
}

TEST(ReadingClock, KnowsWhenReadingsThatAreStampedIrregularlyWereTaken) {
  for (const double stamped : {0.02, 0.1, 0.2, 0.3}) {
    const Times found = run({0.0, stamped});
    EXPECT_LT(found.share, 0.1) << stamped;
    EXPECT_LT(found.off, 0.1 * found.stamps) << stamped;  // 2 / sqrt(1000) of them, and periods that are taken back
  }
}

TEST(ReadingClock, TakesReadingsThatAreTakenIrregularlyAtTheirStamps) {
  for (const double taken : {0.02, 0.1, 0.2, 0.3}) {
    const Times found = run({taken, 0.0});
    EXPECT_GT(found.share, 0.8) << taken;
    EXPECT_LT(found.off, 1e-6) << taken;  // nanoseconds
  }
}

// b is the share of the variance.
TEST(ReadingClock, TellsHowMuchOfBothThereIs) {
  const Times found = run({0.05, 0.1});
  EXPECT_NEAR(found.share, 0.2, 0.05);
  EXPECT_NEAR(found.off, 0.05, 0.01);
}

TEST(ReadingClock, FindsBackAfterLostReadings) {
  for (const double stamped : {0.0, 0.05, 0.1}) {
    const Times found = run({0.0, stamped, 0.01, 0.05});
    EXPECT_LT(found.off, 0.1 * stamped + 1e-6) << stamped;
  }
}

// Of a signal that is at rest, or all noise, nobody knows: stamps are taken at their word.
TEST(ReadingClock, DoesNotKnowBeforeReadingsTell) {
  ReadingClock clock;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int k = 1; k <= 5000; ++k) {
    const Stamp stamp = fromSeconds(kPeriod * (k + 0.1 * normal(random)));
    EXPECT_EQ(clock.take(stamp, 9.81), stamp);
  }
}

// Times go forward whatever becomes known of the stamps, and a pause or another clock begins a line of its own.
TEST(ReadingClock, GoesForwardAndBeginsAnew) {
  ReadingClock clock;
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
      const Stamp found = clock.take(fromSeconds(taken + 0.1 * kPeriod * normal(random)), signal(taken));
      EXPECT_GT(found, last);
      last = found;
    }
    EXPECT_NEAR(toSeconds(last), begin + 4000 * kPeriod, 0.03 * kPeriod) << begin;
  }
}

// Which reading got lost is found out late where stamps are late by a third of a period; a curve through the readings
// may not be torn by that.
TEST(ReadingClock, NeverPutsTwoRegularReadingsIntoOnePlace) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  ReadingClock clock;
  Stamp last{}, before{};
  for (int k = 1; k <= 20000; ++k) {
    const double taken = kPeriod * k;
    const Stamp stamp = fromSeconds(taken + 0.3 * kPeriod * normal(random));
    if (uniform(random) < 0.02) continue;
    if (stamp <= last) {
      clock.passOver(stamp);
      continue;
    }
    last = stamp;
    const Stamp found = clock.take(stamp, signal(taken) + 0.01 * normal(random));
    if (k > 10000) {
      ASSERT_GT(toSeconds(found - before), 0.45 * kPeriod) << k;
    }
    before = found;
  }
  EXPECT_LT(clock.share(), 0.1);
}

// Readings that come half as often, or twice, are no lost ones for long.
TEST(ReadingClock, FollowsAnotherRate) {
  for (const double factor : {0.5, 2.0}) {
    ReadingClock clock;
    double t = 0.0, spacing = kPeriod;
    Stamp found{};
    for (int k = 0; k < 8000; ++k) {
      if (k == 4000) spacing *= factor;
      t += spacing;
      found = clock.take(fromSeconds(t), signal(t));
    }
    EXPECT_NEAR(toSeconds(found), t, 1e-6) << factor;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
