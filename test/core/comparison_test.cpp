#include "suspension_health_monitor/internal/compare/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hidden_effect.h"
#include "recorded_drive.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/search/effect_search.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kNoise = 0.03;  // [m/s^2]
const StrutModel kRough{6.6, 60.0, {}, {}};
const StrutModel kCar{6.0, 63.3, {}, {}};

CompareOptions asGiven() {
  CompareOptions options;
  options.fit = false;
  return options;
}

Comparison compared(const DriveRecord& record, const StrutModel& model = kRough, const CompareOptions& options = {}) {
  Comparison comparison = compareModel({&record}, model, options);
  EXPECT_TRUE(comparison);
  if (comparison) describeFailures(comparison.views, comparison.noise_floor, comparison.where);
  return comparison;
}

SimulationOptions driveWith(const char* effect, std::vector<double> shapes) {
  SimulationOptions options = carDrive(120.0, kNoise);
  options.hidden = {hiddenEffect(options, effect, std::move(shapes), 0.15)};
  return options;
}

const FailureRegion* find(const Comparison& comparison, FailureView view) {
  for (const FailureRegion& region : comparison.where)
    if (region.view == view) return &region;
  return nullptr;
}

TEST(CompareModel, NothingIsNamedWhereNothingIsHidden) {
  for (int seed = 1; seed <= 3; ++seed) {
    const Comparison comparison = compared(recorded(carDrive(120.0, kNoise, seed)));
    ASSERT_EQ(comparison.where.size(), 1u) << seed << ": " << comparison.where[0].sentence;
    EXPECT_EQ(comparison.where[0].view, FailureView::kNone) << seed;
    EXPECT_NEAR(comparison.free_run.rmse, kNoise, 0.1 * kNoise);
    EXPECT_LT(comparison.structured_share, 0.1);
    EXPECT_NEAR(*comparison.held_out_rmse, comparison.free_run.rmse, 0.06 * comparison.free_run.rmse);
  }
}

TEST(CompareModel, AHiddenBumpStopPushesHarderInDeepCompression) {
  const Comparison comparison = compared(recorded(driveWith("bump_stop", {0.012})));
  const FailureRegion& worst = comparison.where[0];
  EXPECT_EQ(worst.view, FailureView::kTravel);
  EXPECT_GT(worst.mean, 0.1);
  EXPECT_NEAR(worst.from, 0.012, 0.003);
  EXPECT_GT(worst.rmse, 2.0 * worst.rmse_elsewhere);
  EXPECT_EQ(worst.sentence.find("In deep compression (travel above "), 0u) << worst.sentence;
  EXPECT_NE(worst.sentence.find(" mm"), std::string::npos) << worst.sentence;
  EXPECT_NE(worst.sentence.find("harder"), std::string::npos) << worst.sentence;
  EXPECT_GT(comparison.structured_share, 0.5);
}

TEST(CompareModel, AHiddenReboundStopHoldsBackFarExtended) {
  const Comparison comparison = compared(recorded(driveWith("rebound_stop", {0.012})));
  const FailureRegion& worst = comparison.where[0];
  EXPECT_EQ(worst.view, FailureView::kTravel);
  EXPECT_LT(worst.mean, -0.1);
  EXPECT_NEAR(worst.to, -0.012, 0.003);
  EXPECT_NE(worst.sentence.find("less"), std::string::npos) << worst.sentence;
}

TEST(CompareModel, FrictionShowsInTheDirectionOfMotion) {
  const Comparison comparison = compared(recorded(driveWith("coulomb_friction", {0.008})));
  const FailureRegion* direction = find(comparison, FailureView::kDirection);
  ASSERT_NE(direction, nullptr);
  EXPECT_GT(direction->mean, 0.0);
  EXPECT_GT(comparison.views.direction.area, 0.0);
  EXPECT_FALSE(comparison.views.whiteness.within);
}

TEST(CompareModel, DriftsShowInTime) {
  for (const char* effect : {"damping_drift", "stiffness_drift"}) {
    const Comparison comparison = compared(recorded(driveWith(effect, {})));
    const FailureRegion* time = find(comparison, FailureView::kTime);
    ASSERT_NE(time, nullptr) << effect;
    const std::string name(effect, std::string(effect).find('_'));
    EXPECT_EQ(time->region.find(name), 0u) << time->region;
    EXPECT_LT(time->sentence.find("less"), time->sentence.find("more")) << time->sentence;  // both rise
  }
}

TEST(CompareModel, TheMissingForceIsTheHiddenOne) {
  const SimulationOptions options = driveWith("bump_stop", {0.012});
  const Comparison comparison = compared(recorded(options), kCar, asGiven());
  const ComparedSegment& segment = comparison.segments.at(0);
  const std::vector<DriveSample> samples = drive(options);
  const ActiveEffect& hidden = options.hidden[0];
  double product = 0.0, square = 0.0, plain = 0.0;
  for (std::size_t k = 500; k + 500 < segment.size(); ++k) {
    const DriveTruth& truth = samples[k + kInterpolationReach].truth;
    const double force =
        hidden.coefficient * hidden.effect.force({truth.travel, truth.travel_rate, 0.0, 0.0}, hidden.shapes.data());
    product += force * segment.missing_force[k];
    plain += force * segment.residual(k);
    square += force * force;
  }
  EXPECT_NEAR(product / square, 1.0, 0.1);
  EXPECT_LT(plain / square, 0.8);  // what the residual alone shows of it
}

TEST(CompareModel, AWrongNumberFollowsTheWheelAndLeavesMoreInBothErrors) {
  const DriveRecord record = recorded(carDrive(120.0, kNoise));
  const Comparison right = compared(record, kCar, asGiven());
  const Comparison wrong = compared(record, {4.0, 63.3, {}, {}}, asGiven());
  EXPECT_EQ(wrong.model.damping_to_mass, 4.0);
  EXPECT_TRUE(wrong.stddev.empty());
  EXPECT_EQ(right.where[0].view, FailureView::kNone) << right.where[0].sentence;
  EXPECT_GT(wrong.free_run.rmse, 3.0 * right.free_run.rmse);
  EXPECT_GT(wrong.one_step->rmse, 3.0 * right.one_step->rmse);
  EXPECT_LT(wrong.free_run.fit_percent, right.free_run.fit_percent);
  EXPECT_FALSE(wrong.views.cross_correlation.within);
  const FailureRegion* frequency = find(wrong, FailureView::kFrequency);
  ASSERT_NE(frequency, nullptr);
  EXPECT_NE(frequency->sentence.find("numbers are off"), std::string::npos) << frequency->sentence;
  const TimeBin& bin = wrong.views.time.at(3);
  EXPECT_NEAR(bin.damping_error, 2.0, 0.3);
}

TEST(CompareModel, TheTrueModelOfAHiddenEffectLeavesNoise) {
  const SimulationOptions options = driveWith("bump_stop", {0.012});
  const DriveRecord record = recorded(options);
  const Comparison truth = compared(record, {6.0, 63.3, options.hidden, {}}, asGiven());
  EXPECT_EQ(truth.where[0].view, FailureView::kNone) << truth.where[0].sentence;
  EXPECT_NEAR(truth.free_run.rmse, kNoise, 0.15 * kNoise);
  // The effect's column is in the rows, too.
  EXPECT_LT(truth.one_step->rmse, 0.5 * compared(record).one_step->rmse);
  double largest = 0.0;
  for (const double force : truth.segments[0].added_force) largest = std::max(largest, force);
  EXPECT_GT(largest, 0.2);
}

TEST(CompareModel, FitPercentIsAsDefined) {
  const Comparison comparison = compared(recorded(carDrive(30.0, kNoise)));
  const ComparedSegment& segment = comparison.segments.at(0);
  double mean = 0.0, error = 0.0, spread = 0.0;
  for (const double y : segment.measured) mean += y / static_cast<double>(segment.size());
  for (std::size_t k = 0; k < segment.size(); ++k) {
    error += std::pow(segment.measured[k] - segment.predicted[k], 2);
    spread += std::pow(segment.measured[k] - mean, 2);
  }
  EXPECT_NEAR(comparison.free_run.fit_percent, 100.0 * (1.0 - std::sqrt(error / spread)), 1e-9);
  EXPECT_NEAR(comparison.free_run.rmse, std::sqrt(error / static_cast<double>(segment.size())), 1e-12);
}

/// The drive with lengths and times multiplied.
DriveRecord scaled(const SimulationOptions& options, double length, double time) {
  Drive record_drive;
  const double factor = length / (time * time);
  for (const DriveSample& sample : drive(options))
    record_drive.samples.push_back({fromSeconds(toSeconds(sample.stamp) * time), factor * sample.sprung->acceleration,
                                    factor * sample.unsprung->acceleration});
  const DriveRecord record(record_drive, time / options.rate, 1);
  return record;
}

TEST(CompareModel, NothingDependsOnTheUnitsOfLengthAndTime) {
  const SimulationOptions options = driveWith("bump_stop", {0.012});
  const Comparison metres = compared(scaled(options, 1.0, 1.0));
  for (const auto& [length, time] : {std::pair{100.0, 1.0}, std::pair{1.0, 0.0625}, std::pair{8.0, 0.03125}}) {
    const Comparison other = compared(scaled(options, length, time), {6.6 / time, 60.0 / (time * time), {}, {}});
    const double acceleration = length / (time * time);
    EXPECT_NEAR(other.free_run.rmse, acceleration * metres.free_run.rmse, 1e-3 * other.free_run.rmse);
    EXPECT_NEAR(other.one_step->rmse, acceleration * metres.one_step->rmse, 1e-3 * other.one_step->rmse);
    EXPECT_NEAR(other.structured_share, metres.structured_share, 1e-3);
    ASSERT_EQ(other.where.size(), metres.where.size());
    for (std::size_t i = 0; i < other.where.size(); ++i) EXPECT_EQ(other.where[i].view, metres.where[i].view);
    EXPECT_NEAR(other.where[0].from, length * metres.where[0].from, 1e-2 * other.where[0].from);
    EXPECT_EQ(other.views.whiteness.value.size(), metres.views.whiteness.value.size());
  }
}

TEST(CompareModel, SeveralDrivesAreKeptApart) {
  const DriveRecord first = recorded(carDrive(60.0, kNoise, 1)), second = recorded(carDrive(60.0, kNoise, 2));
  const Comparison comparison = compareModel({&first, &second}, kRough);
  ASSERT_TRUE(comparison);
  ASSERT_EQ(comparison.segments.size(), 2u);
  EXPECT_EQ(comparison.segments[1].drive, 1u);
  EXPECT_EQ(comparison.views.time.front().drive, 0u);
  EXPECT_EQ(comparison.views.time.back().drive, 1u);
  EXPECT_EQ(comparison.views.time.back().to, comparison.segments[1].time(comparison.segments[1].size()));
}

TEST(CompareModel, TooLittleIsNothing) {
  const DriveRecord calm = recorded(
      2000, 0.01, [](int) { return 9.81; }, [](int) { return 9.81; });
  const DriveRecord brief = recorded(carDrive(1.0, kNoise));
  EXPECT_EQ(compareModel({}, kRough).shortcoming, Shortcoming::kTooShort);
  EXPECT_NE(compareModel({&calm}, kRough).shortcoming, Shortcoming::kNone);
  EXPECT_NE(compareModel({&brief}, kRough).shortcoming, Shortcoming::kNone);
  EXPECT_EQ(compareModel({&brief}, {-1.0, 63.3, {}, {}}, asGiven()).shortcoming, Shortcoming::kNoDampedSpring);
}

// The drive of a strut whose spring pushes the wrong way, slowly enough for half a minute: the best fit has b0 < 0.
// Once that made sizes of buffers out of NaN.
TEST(CompareModel, AFitThatIsNoSpringHasAReason) {
  constexpr double period = 0.01, b1 = 8.0, b0 = -0.3;
  constexpr int steps = 20;
  Drive source;
  double d = 0.0, v = 0.0;
  for (int k = 0; k < 3000 * steps; ++k) {
    const double t = k * period / steps, y = b1 * v + b0 * d;
    double wheel = 0.0;
    for (const double f : {0.07, 0.13, 0.31, 0.7, 1.3, 2.9, 5.3}) wheel += std::sin(2.0 * M_PI * f * t + 9.0 * f);
    if (k % steps == 0) source.samples.push_back({fromSeconds(t), y + 1e-3 * std::sin(777.0 * t), wheel});
    v += period / steps * (wheel - y);
    d += period / steps * v;
  }
  const DriveRecord record(source, period);
  EXPECT_EQ(compareModel({&record}, {b1, 0.5, {}, {}}).shortcoming, Shortcoming::kNoStableFit);
  EXPECT_EQ(searchEffects({&record}, {b1, 0.5, {}, {}}).shortcoming, Shortcoming::kNoStableFit);
  for (const double wrong : {-63.3, 0.0, std::nan("")})
    EXPECT_EQ(compareModel({&record}, {6.0, wrong, {}, {}}, asGiven()).shortcoming, Shortcoming::kNoDampedSpring);
}

// A spring so soft that a drive does not show it: the integrals of the residual need no more room than the drive.
TEST(CompareModel, ANaturalPeriodOfYearsNeedsNoMemory) {
  const DriveRecord record = recorded(carDrive(30.0, kNoise));
  const Comparison comparison = compareModel({&record}, {6.0, 1e-14, {}, {}}, asGiven());
  for (const ComparedSegment& segment : comparison.segments)
    EXPECT_EQ(segment.missing_force.size(), segment.measured.size());
}

TEST(EstimateInitialStates, FindsTheStateInWhichASegmentBegins) {
  const SimulationOptions options = carDrive(30.0, 0.0);
  const DriveRecord record = recorded(options);
  const auto states = estimateInitialStates({&record}, kCar);
  ASSERT_TRUE(states);
  ASSERT_EQ(states->size(), 1u);
  const DriveTruth start = drive(options)[kInterpolationReach].truth;
  EXPECT_NEAR((*states)[0].travel + record.gravity() / 63.3, start.travel, 5e-4);
  EXPECT_NEAR((*states)[0].travel_rate, start.travel_rate, 5e-3);
  EXPECT_GT(std::abs(start.travel_rate), 0.02);
}

}  // namespace
}  // namespace suspension_health_monitor
