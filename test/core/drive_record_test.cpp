#include "suspension_health_monitor/internal/record/drive_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "recorded_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01, kOmega = 2.0 * 3.14159265358979 * 5.0;  // 20 samples a period
constexpr int kEnd = kInterpolationReach;                                // samples lost at each end

double body(int k) { return 9.81 + 0.3 + std::cos(kOmega * k * kPeriod); }
double wheel(int k) { return 9.81 + 2.0 * std::sin(kOmega * k * kPeriod); }

// Pushes samples 0 .. 399 as `change` leaves them; false leaves one out.
DriveRecord changed(const std::function<bool(int, CornerSample&)>& change) {
  Drive record_drive;
  for (int k = 0; k < 400; ++k) {
    CornerSample sample{std::chrono::hours(400000) + fromSeconds(k * kPeriod), body(k), wheel(k)};
    if (change(k, sample)) record_drive.samples.push_back(sample);
  }
  const DriveRecord record(record_drive, kPeriod, 1);
  return record;
}

TEST(DriveRecord, MeanOfTheWheelIsTakenOffBothSignals) {
  const DriveRecord record = recorded(400, kPeriod, body, wheel);
  EXPECT_NEAR(record.gravity(), 9.81, 1e-12);  // 20 whole periods
  ASSERT_EQ(record.segments().size(), 1u);
  const DriveSegment& segment = record.segments().front();
  ASSERT_EQ(segment.size(), 400u - 2 * kEnd);
  EXPECT_EQ(record.numSamples(), segment.size());
  ASSERT_EQ(segment.wheel.size(), segment.size() - 1);
  double change = 0.0;  // over whole periods the wheel's velocity comes back: nothing of gravity is left
  for (std::size_t k = 0; k < 360; ++k) change += segment.wheel[k].end_velocity;
  EXPECT_NEAR(change, 0.0, 1e-6);
}

TEST(DriveRecord, IndicesOfBothSignalsAndTheStartAgree) {
  for (const int steps : {1, 2}) {
    const DriveRecord record = recorded(400, kPeriod, body, wheel, steps);
    const DriveSegment& segment = record.segments().front();
    EXPECT_NEAR(segment.start, kEnd * kPeriod, 1e-9);
    for (const int k : {0, 3, 100, 374}) {
      const double time = segment.start + k * kPeriod;
      EXPECT_NEAR(segment.sprung[static_cast<std::size_t>(k)], 0.3 + std::cos(kOmega * time), 1e-9);
      for (int s = 0; s < steps; ++s) {
        const double from = time + s * kPeriod / steps, to = from + kPeriod / steps;
        const double gain = 2.0 * (std::cos(kOmega * from) - std::cos(kOmega * to)) / kOmega;
        EXPECT_NEAR(segment.wheel[static_cast<std::size_t>(k * steps + s)].end_velocity, gain, 2.0 * kPeriod * 1e-4);
      }
    }
  }
}

TEST(DriveRecord, AGapEndsAStretchAndTimeGoesOn) {
  const DriveRecord record = changed([](int k, CornerSample&) { return k != 100; });
  ASSERT_EQ(record.segments().size(), 2u);
  const DriveSegment &before = record.segments()[0], &after = record.segments()[1];
  EXPECT_EQ(before.size(), 100u - 2 * kEnd);
  EXPECT_EQ(after.size(), 299u - 2 * kEnd);
  EXPECT_NEAR(before.start, kEnd * kPeriod, 1e-9);
  EXPECT_NEAR(after.start, (101 + kEnd) * kPeriod, 1e-9);
  // One mean for the drive, not one per stretch.
  EXPECT_NEAR(before.sprung[0] + record.gravity(), body(kEnd), 1e-9);
  EXPECT_NEAR(after.sprung[0] + record.gravity(), body(101 + kEnd), 1e-9);
}

TEST(DriveRecord, StretchesThatAreTooShortAreDropped) {
  const DriveRecord record = changed([](int k, CornerSample&) { return k != 50; });
  ASSERT_EQ(record.segments().size(), 1u);
  EXPECT_NEAR(record.segments()[0].start, (51 + kEnd) * kPeriod, 1e-9);
}

TEST(DriveRecord, ASensorThatIsStuckEndsAStretchAndLeavesNothing) {
  for (const bool sprung : {true, false}) {
    const DriveRecord record = changed([sprung](int k, CornerSample& sample) {
      if (k >= 100 && k < 160) (sprung ? sample.sprung_acceleration : sample.unsprung_acceleration) = 0.0;
      return true;
    });
    ASSERT_EQ(record.segments().size(), 2u);
    EXPECT_EQ(record.segments()[0].size(), 100u - 2 * kEnd);
    EXPECT_EQ(record.segments()[1].size(), 240u - 2 * kEnd);
    EXPECT_NEAR(record.segments()[1].start, (160 + kEnd) * kPeriod, 1e-9);
    EXPECT_NEAR(record.gravity(), 9.81, 1e-9);  // 5 and 12 whole periods are left; no lost reading counts
  }
}

TEST(DriveRecord, AFewEqualReadingsAreNotStuckOnes) {
  for (const int equal : {4, 5}) {
    const DriveRecord record = changed([equal](int k, CornerSample& sample) {
      if (k >= 100 && k < 100 + equal) sample.sprung_acceleration = 9.0;
      return true;
    });
    EXPECT_EQ(record.segments().size(), equal == 4 ? 1u : 2u) << equal;
  }
}

TEST(DriveRecord, RepeatedStampsAreIgnored) {
  Drive record_drive;
  for (int k = 0; k < 400; ++k)
    for (int again = 0; again < 2; ++again)
      record_drive.samples.push_back({fromSeconds(k * kPeriod), again ? 100.0 : body(k), again ? 100.0 : wheel(k)});
  const DriveRecord record(record_drive, kPeriod, 1);
  ASSERT_EQ(record.segments().size(), 1u);
  EXPECT_EQ(record.numSamples(), 400u - 2 * kEnd);
  EXPECT_NEAR(record.gravity(), 9.81, 1e-12);
}

TEST(DriveRecord, AnEmptyDriveHasNoSegments) {
  Drive record_drive;
  const DriveRecord record(record_drive, kPeriod, 1);
  EXPECT_TRUE(record.segments().empty());
  EXPECT_EQ(record.numSamples(), 0u);
}

}  // namespace
}  // namespace suspension_health_monitor
