#include "suspension_health_monitor/internal/vehicle/rough_strut.h"

#include <gtest/gtest.h>

#include <random>

#include "hidden_effect.h"
#include "simulated_drive.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/record/motion.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.02;

SimulationOptions healthyDrive() {
  SimulationOptions options = scenario("paper_clean", 60.0);
  options.damping_end_fraction = 1.0;
  options.noise = 0.0;
  return options;
}

Drive driveOf(const std::vector<DriveSample>& drive, Stamp shift = {}) {
  Drive result;
  for (const DriveSample& sample : drive)
    result.samples.push_back(
        {shift + sample.sprung->stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
  return result;
}

TEST(RoughStrut, IsThatOfTheVehicle) {
  const std::optional<RoughStrut> rough = roughStrut({driveOf(drive(healthyDrive()))}, kPeriod);
  ASSERT_TRUE(rough);
  EXPECT_NEAR(rough->strut.damping_to_mass, 3.0, 0.03);
  EXPECT_NEAR(rough->strut.stiffness_to_mass, 13.8, 0.14);
  EXPECT_FALSE(rough->clocksDiffer(kPeriod));
}

TEST(RoughStrut, NoBlockSpansTwoDrivesOrAGap) {
  // The second drive's readings are offset alike: a block that spanned the step would see a jump of 100 m/s^2.
  const std::vector<DriveSample> simulated = drive(healthyDrive());
  Drive first = driveOf(simulated), second = driveOf(simulated, std::chrono::seconds(100));
  for (CornerSample& sample : second.samples) {
    sample.sprung_acceleration += 100.0;
    sample.unsprung_acceleration += 100.0;
  }
  Drive joined = first;
  joined.samples.insert(joined.samples.end(), second.samples.begin(), second.samples.end());
  const LinearStrut alone = roughStrut({first}, kPeriod).value().strut;
  for (const std::vector<Drive>& drives : {std::vector<Drive>{first, second}, {joined}}) {
    const LinearStrut both = roughStrut(drives, kPeriod).value().strut;
    EXPECT_NEAR(both.damping_to_mass, alone.damping_to_mass, 1e-3 * alone.damping_to_mass);
    EXPECT_NEAR(both.stiffness_to_mass, alone.stiffness_to_mass, 1e-3 * alone.stiffness_to_mass);
  }
}

TEST(RoughStrut, ProposesTheHorizonThatTheTrueParametersAskFor) {
  SimulationOptions options = scenario("iso_road", 30.0);
  options.vehicle = "golden_car";
  options.rate = 200.0;
  options.noise = 0.1;
  const int expected = horizonSamples(proposeHorizon(6.0, 63.3), 1.0 / options.rate);
  Drive measured = driveOf(drive(options));
  const int found = roughStrut({measured}, 1.0 / options.rate).value().horizonSamples(1.0 / options.rate);
  EXPECT_NEAR(found, expected, 0.1 * expected);
  for (CornerSample& sample : measured.samples) {
    sample.sprung_acceleration *= 1e-3;  // in another unit
    sample.unsprung_acceleration *= 1e-3;
  }
  EXPECT_EQ(roughStrut({measured}, 1.0 / options.rate).value().horizonSamples(1.0 / options.rate), found);
}

TEST(RoughStrut, IsThereForDrivesOfThreeSecondsAndForStrutsOfOtherKinds) {
  const std::optional<RoughStrut> brief = roughStrut({driveOf(drive(carDrive(3.0, 0.03)))}, 0.01);
  ASSERT_TRUE(brief);
  EXPECT_NEAR(brief->strut.stiffness_to_mass, 63.3, 20.0);
  const Drive car = driveOf(drive(carDrive(60.0, 0.0)));
  for (const double slower : {0.03, 10.0}) {  // the same strut in another time
    Drive scaled;
    for (const CornerSample& sample : car.samples)
      scaled.samples.push_back(
          {fromSeconds(slower * toSeconds(sample.stamp)), sample.sprung_acceleration, sample.unsprung_acceleration});
    const std::optional<RoughStrut> rough = roughStrut({scaled}, slower * 0.01);
    ASSERT_TRUE(rough) << slower;
    EXPECT_NEAR(rough->strut.stiffness_to_mass * slower * slower, 63.3, 3.0) << slower;
  }
}

TEST(RoughStrut, NothingThatMovesIsNoStrutAndNoiseNeither) {
  Drive parked;
  for (int i = 0; i < 2000; ++i) parked.samples.push_back({fromSeconds(kPeriod * i), 9.81, 9.81});
  EXPECT_FALSE(roughStrut({parked}, kPeriod));
  EXPECT_FALSE(roughStrut({Drive{}}, kPeriod));
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 0.024);
    for (CornerSample& sample : parked.samples) sample = {sample.stamp, 9.81 + noise(engine), 9.81 + noise(engine)};
    EXPECT_FALSE(roughStrut({parked}, kPeriod)) << seed;
  }
}

// So small that squares vanish.
TEST(RoughStrut, TakesNoParametersThatAreNoNumbers) {
  Drive tiny = driveOf(drive(healthyDrive()));
  for (CornerSample& sample : tiny.samples) {
    sample.sprung_acceleration *= 1e-150;
    sample.unsprung_acceleration *= 1e-150;
  }
  EXPECT_NO_THROW(roughStrut({tiny}, kPeriod));
}

TEST(DriveRecords, EveryDriveIsARecordInStepsThatTheStrutNeeds) {
  const Drive samples = driveOf(drive(healthyDrive()));
  const StrutModel slow{3.0, 13.8, {}, {}}, fast{3.0, 1e4, {}, {}};
  const std::deque<DriveRecord> records = makeRecords({samples, samples}, kPeriod, slow);
  ASSERT_EQ(pointersTo(records).size(), 2U);
  EXPECT_EQ(pointersTo(records)[1], &records[1]);
  EXPECT_EQ(records[0].numSamples(), records[1].numSamples());
  EXPECT_GT(records[0].numSamples(), 2900U);
  EXPECT_EQ(records[0].segments().front().steps, 1);
  EXPECT_EQ(makeRecords({samples}, kPeriod, fast).front().segments().front().steps, 6);  // 0.02 s * 100 1/s / 0.35
}

TEST(MotionScale, IsTheMotionOfTheStrut) {
  const std::vector<DriveSample> simulated = drive(healthyDrive());
  double travel = 0.0, rate = 0.0;
  for (const DriveSample& sample : simulated) {
    travel += sample.truth.travel * sample.truth.travel;
    rate += sample.truth.travel_rate * sample.truth.travel_rate;
  }
  const auto rms = [&](double sum) { return std::sqrt(sum / static_cast<double>(simulated.size())); };
  const std::optional<MotionScale> scale = motionScale(driveOf(simulated).samples, kPeriod, 3.0, 13.8);
  ASSERT_TRUE(scale);
  EXPECT_NEAR(scale->unit(ShapeScale::kTravel), rms(travel), 0.1 * rms(travel));
  EXPECT_NEAR(scale->unit(ShapeScale::kTravelRate), rms(rate), 0.1 * rms(rate));
  EXPECT_NEAR(scale->unit(ShapeScale::kTime), 1.0 / std::sqrt(13.8), 1e-12);
  EXPECT_NEAR(scale->unit(ShapeScale::kFrequency), std::sqrt(13.8) / (2.0 * M_PI), 1e-12);
  EXPECT_EQ(scale->unit(ShapeScale::kNone), 1.0);
}

TEST(MotionScale, CannotBeToldWithoutAStrutOrMotion) {
  const std::vector<CornerSample> samples = driveOf(drive(healthyDrive())).samples;
  std::vector<CornerSample> parked = samples;
  for (CornerSample& sample : parked) sample.sprung_acceleration = sample.unsprung_acceleration = 0.0;
  EXPECT_FALSE(motionScale(samples, kPeriod, std::nan(""), std::nan("")));
  EXPECT_FALSE(motionScale(samples, kPeriod, 3.0, -13.8));
  EXPECT_FALSE(motionScale(parked, kPeriod, 3.0, 13.8));
  EXPECT_FALSE(motionScale({samples.begin(), samples.begin() + 20}, kPeriod, 3.0, 13.8));
}

}  // namespace
}  // namespace suspension_health_monitor
