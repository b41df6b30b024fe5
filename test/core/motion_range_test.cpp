#include "suspension_health_monitor/internal/record/motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;

/// Body and wheel against each other, their travel rate a sum of sines, given as frequency [Hz] and amplitude [m/s].
/// A body at rest would be a sensor that is stuck.
Drive sines(const std::vector<std::pair<double, double>>& parts, double duration) {
  std::vector<double> body, wheel;
  for (double t = 0.0; t < duration; t += kPeriod) {
    body.push_back(0.0);
    wheel.push_back(0.0);
    for (const auto& [frequency, rate] : parts) {
      const double w = 2.0 * M_PI * frequency;
      wheel.back() += w * rate / 2.0 * std::cos(w * t);
    }
    body.back() = -wheel.back();
  }
  return makeDrive(kPeriod, body, wheel);
}

std::optional<MotionRange> rangeOf(const std::vector<Drive>& drives) {
  const auto records = makeRecords(drives, kPeriod, StrutModel());
  return rangeOfMotion(pointersTo(records));
}

TEST(MotionRange, OneSineIsOneFrequency) {
  const auto range = rangeOf({sines({{1.1, 0.2}}, 30.0)});
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->low, 1.1, 2.0 * range->resolution);
  EXPECT_NEAR(range->high, 1.1, 2.0 * range->resolution);
  EXPECT_TRUE(range->isOneFrequency());
  EXPECT_FALSE(range->isWide());
}

TEST(MotionRange, SinesAnOctaveApartAreNotOneFrequencyUnlessOneIsHardlyThere) {
  EXPECT_TRUE(rangeOf({sines({{1.0, 0.2}, {2.5, 0.2}}, 30.0)})->isWide());
  // A twentieth of the power of the travel rate, not of the acceleration: 16 times as much there at 4 times the
  // frequency.
  EXPECT_TRUE(rangeOf({sines({{1.0, 0.2}, {4.0, 0.03}}, 30.0)})->isOneFrequency());
}

TEST(MotionRange, DrivesCountTogether) {
  const Drive slow = sines({{1.0, 0.2}}, 30.0), quick = sines({{3.0, 0.2}}, 30.0);
  EXPECT_TRUE(rangeOf({slow})->isOneFrequency());
  EXPECT_TRUE(rangeOf({slow, quick})->isWide());
}

TEST(MotionRange, OfAShortRecordOneSineIsNeitherOneFrequencyNorWide) {
  const auto range = rangeOf({sines({{0.5, 0.2}}, 4.0)});
  ASSERT_TRUE(range);
  EXPECT_FALSE(range->isWide());
}

TEST(MotionRange, NothingMovesOrTooShortIsNoRange) {
  EXPECT_FALSE(rangeOf({sines({}, 30.0)}));
  EXPECT_FALSE(rangeOf({sines({{1.0, 0.2}}, 0.3)}));
}

TEST(MotionRange, LinearForcesAndFaultsOfReadingsAreWhatOneFrequencyCannotTell) {
  EffectLibrary library = builtInEffects();
  const std::size_t faults = library.readings.size();
  std::vector<std::string> names = takeFrequencyResponses(library);
  EXPECT_TRUE(library.readings.empty());
  names.resize(names.size() - faults);
  EXPECT_EQ(names, (std::vector<std::string>{"viscoelastic_mount", "body_drag", "load_on_spring"}));
}

}  // namespace
}  // namespace suspension_health_monitor
