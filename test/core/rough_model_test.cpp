#include "suspension_health_monitor/internal/fit/rough_model.h"

#include <gtest/gtest.h>

#include "simulated_drive.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/record/motion_scale.h"

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

IntegralFilterOptions filter() {
  IntegralFilterOptions options;
  options.period = kPeriod;
  options.horizon_samples = 30;
  return options;
}

TEST(RoughModel, RoughModelIsThatOfTheVehicle) {
  const StrutModel rough = roughModel({driveOf(drive(healthyDrive()))}, filter());
  EXPECT_TRUE(isDampedSpring(rough));
  EXPECT_NEAR(rough.damping_to_mass, 3.0, 0.03);
  EXPECT_NEAR(rough.stiffness_to_mass, 13.8, 0.14);
}

TEST(RoughModel, NoRowOfTheRoughModelSpansTwoDrivesOrAGap) {
  // The second drive's readings are offset alike: a row that spanned the step would see a jump of 100 m/s^2.
  const std::vector<DriveSample> simulated = drive(healthyDrive());
  Drive first = driveOf(simulated), second = driveOf(simulated, std::chrono::seconds(100));
  for (CornerSample& sample : second.samples) {
    sample.sprung_acceleration += 100.0;
    sample.unsprung_acceleration += 100.0;
  }
  Drive joined = first;
  joined.samples.insert(joined.samples.end(), second.samples.begin(), second.samples.end());
  const StrutModel alone = roughModel({first}, filter());
  for (const StrutModel& rough : {roughModel({first, second}, filter()), roughModel({joined}, filter())}) {
    EXPECT_NEAR(rough.damping_to_mass, alone.damping_to_mass, 1e-3 * alone.damping_to_mass);
    EXPECT_NEAR(rough.stiffness_to_mass, alone.stiffness_to_mass, 1e-3 * alone.stiffness_to_mass);
  }
}

TEST(RoughModel, NothingThatMovesIsNoStrut) {
  Drive parked;
  for (int i = 0; i < 500; ++i) parked.samples.push_back({fromSeconds(kPeriod * i), 9.81, 9.81});
  EXPECT_FALSE(isDampedSpring(roughModel({parked}, filter())));
  EXPECT_FALSE(isDampedSpring(roughModel({Drive{}}, filter())));
}

TEST(RoughModel, EveryDriveIsARecordInStepsThatTheStrutNeeds) {
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
