#include "suspension_health_monitor/internal/signal/stream_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "uniform_grid.h"

namespace suspension_health_monitor {
namespace {

constexpr Stamp kPeriod = std::chrono::milliseconds(10);

Stamp at(int index) { return index * kPeriod; }

TEST(RejectCounts, AddUp) {
  RejectCounts a, b;
  a.add(RejectReason::kTooSoon);
  b.add(RejectReason::kTooSoon);
  b.add(RejectReason::kNotMeasured);
  a += b;
  EXPECT_EQ(a.count(RejectReason::kTooSoon), 2u);
  EXPECT_EQ(a.total(), 3u);
  EXPECT_EQ(kRejectReasonNames[static_cast<std::size_t>(RejectReason::kTooSoon)], "too_soon");
  EXPECT_EQ(kRejectReasonNames[static_cast<std::size_t>(RejectReason::kNoTransform)], "no_transform");
}

/// A body that shakes by 3 m/s^2 rms around gravity, as a 16 bit sensor of +-2 g reads it, limited to `limit`.
class Shaken {
 public:
  explicit Shaken(double limit) : limit_(limit) {}
  double next() {
    constexpr double kResolution = 4.0 * 9.81 / 65536.0;
    state_ = 0.9 * state_ + std::sqrt(1.0 - 0.81) * normal_(generator_);
    const double reading = std::clamp(9.81 + 3.0 * state_, -limit_, limit_);
    return kResolution * std::round(reading / kResolution);
  }

 private:
  double limit_;
  double state_ = 0.0;
  std::mt19937 generator_{7};
  std::normal_distribution<double> normal_;
};

TEST(StreamGate, KeepsOutWhatIsClippedAtARangeThatNobodyToldIt) {
  Shaken body(15.0), unlimited(1e9);
  StreamGate gate(kPeriod), free(kPeriod);
  double limit = 0.0;
  int clipped = 0, let_through = 0;
  for (int k = 0; k < 20000; ++k) {
    const double reading = body.next();
    limit = std::max(limit, reading);
    const bool passes = gate.judge(at(k), reading) == StreamGate::Verdict::kPasses;
    if (k < 2000) continue;  // it has learned the limit by then
    clipped += reading == limit ? 1 : 0;
    let_through += reading == limit && passes ? 1 : 0;
    EXPECT_TRUE(passes || reading == limit) << k;
    free.judge(at(k), unlimited.next());
  }
  EXPECT_GT(clipped, 400);
  EXPECT_EQ(let_through, 0);
  EXPECT_EQ(free.rejected().total(), 0u);
}

TEST(StreamGate, OfAForceKeepsOutWhatIsNoNumberInAnyUnit) {
  StreamGate gate(kPeriod, true);
  int k = 0;
  for (; k < 500; ++k) ASSERT_EQ(gate.judge(at(k), 0.0), StreamGate::Verdict::kPasses) << k;
  for (const double value : {3e4, -2e7, 3e4}) EXPECT_EQ(gate.judge(at(k++), value), StreamGate::Verdict::kPasses);
  EXPECT_EQ(gate.judge(at(k++), std::nan("")), StreamGate::Verdict::kRejected);
  EXPECT_EQ(gate.judge(at(k++), 1e20), StreamGate::Verdict::kRejected);
  EXPECT_EQ(gate.judge(at(k), 1.0), StreamGate::Verdict::kRejected);  // beside what is absurd
  EXPECT_EQ(gate.judge(at(k - 5), 1.0), StreamGate::Verdict::kRejected);
  EXPECT_EQ(gate.rejected().byName(),
            (std::map<std::string, std::uint64_t>{{"absurd", 2u}, {"not_finite", 1u}, {"time_went_back", 1u}}));
  EXPECT_FALSE(gate.isStill());
}

TEST(StreamGate, GivesALimitUpThatIsExceeded) {
  StreamGate gate(kPeriod);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int k = 0;
  for (; k < 500; ++k) gate.judge(at(k), uniform(generator));
  for (int i = 0; i < 5; ++i, ++k) gate.judge(at(k), 2.0);
  EXPECT_EQ(gate.rejected().count(RejectReason::kClipped), 3u);
  EXPECT_EQ(gate.judge(at(k++), 5.0), StreamGate::Verdict::kPasses);
  EXPECT_EQ(gate.judge(at(k++), 2.0), StreamGate::Verdict::kPasses);
}

TEST(StreamGate, TakesTheRepeatedReadingsOfACoarseSensorForWhatTheyAre) {
  std::mt19937 generator(5);
  std::normal_distribution<double> noise(0.0, 0.3);
  StreamGate gate(kPeriod);
  for (int k = 0; k < 20000; ++k) gate.judge(at(k), std::round(noise(generator)));  // a step of 3 standard deviations
  EXPECT_EQ(gate.rejected().total(), 0u);
}

TEST(StreamGate, MeasuresRateJitterAndLosses) {
  StreamGate gate(kPeriod);
  std::mt19937 generator(11);
  std::uniform_int_distribution<int> jitter(-500, 500);  // [us]
  constexpr int kCount = 20000;
  int lost = 0;
  for (int k = 0; k < kCount; ++k) {
    if (k % 50 == 49) {
      ++lost;
      continue;
    }
    gate.judge(at(k) + std::chrono::microseconds(jitter(generator)), std::sin(0.1 * k));
  }
  EXPECT_EQ(gate.clock().lost(), static_cast<std::uint64_t>(lost) - 1);  // the last one is not missed yet
  // Differences of independent uniform jitters of +-0.5 ms: standard deviation 1 ms / sqrt(6).
  EXPECT_NEAR(gate.clock().jitter(), 1e-3 / std::sqrt(6.0), 0.1e-3 / std::sqrt(6.0));
  EXPECT_NEAR(gate.clock().period(), 0.01, 5 * 1e-3 / std::sqrt(6.0) / std::sqrt(1000.0));
}

TEST(StreamGate, TakesALowerRateForTheRateAfterAWhile) {
  StreamGate gate(kPeriod);
  int k = 0;
  for (; k < 1000; ++k) gate.judge(at(k), std::sin(0.1 * k));
  for (; k < 3000; k += 2) gate.judge(at(k), std::sin(0.1 * k));
  EXPECT_NEAR(gate.clock().period(), 0.02, 1e-9);
  EXPECT_LT(gate.clock().lost(), 10u);
}

TEST(StreamGate, CountsAPauseAsNoLoss) {
  StreamGate gate(kPeriod);
  for (int k = 0; k < 100; ++k) gate.judge(at(k), std::sin(0.1 * k));
  for (int k = 1000; k < 1100; ++k) gate.judge(at(k), std::sin(0.1 * k));
  EXPECT_EQ(gate.clock().lost(), 0u);
  EXPECT_NEAR(gate.clock().period(), 0.01, 1e-9);
}

/// Both sensors of a strut, one of them stuck from sample 100 to 200. @return samples that come in these.
int samplesWhileStuck(UniformGrid& grid, bool both) {
  int samples = 0;
  for (int k = 0; k < 400; ++k) {
    const bool stuck = k >= 100 && k < 200;
    grid.push(Side::kSprung, at(k), stuck ? 9.81 : 9.81 + std::sin(0.3 * k));
    const bool came = grid.push(Side::kUnsprung, at(k), stuck && both ? 9.81 : 9.81 + std::sin(0.7 * k)).has_value();
    if (stuck && came) ++samples;
    EXPECT_TRUE(came || stuck) << k;
  }
  return samples;
}

TEST(UniformGrid, KeepsOutASensorThatIsStuckWhileTheOtherOneMoves) {
  UniformGrid grid(0.01);
  EXPECT_EQ(samplesWhileStuck(grid, false), 19);  // before it can be told
  EXPECT_EQ(grid.streams().rejected().count(RejectReason::kStuck), 81u);
  EXPECT_EQ(grid.streams().rejected().total(), 81u);
}

TEST(UniformGrid, LetsSensorsPassThatStandStillTogether) {
  UniformGrid grid(0.01);
  EXPECT_EQ(samplesWhileStuck(grid, true), 100);
  EXPECT_EQ(grid.streams().rejected().total(), 0u);
}

}  // namespace
}  // namespace suspension_health_monitor
