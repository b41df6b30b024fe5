#include "suspension_health_monitor/discrepancy/search_drives.h"

#include <gtest/gtest.h>

#include "simulated_drive.h"
#include "suspension_health_monitor/discrepancy/motion_scale.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.02;

SimulationOptions healthyDrive() {
  SimulationOptions options = scenario("paper_clean", 60.0);
  options.damping_ramp = false;
  options.noise = 0.0;
  return options;
}

DriveSamples samplesOf(const std::vector<DriveSample>& drive, Stamp shift = {}) {
  DriveSamples samples;
  for (const DriveSample& sample : drive)
    samples.push_back({shift + sample.sprung->stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
  return samples;
}

MonitorOptions options() {
  MonitorOptions monitor;
  monitor.sample_period = kPeriod;
  return monitor;
}

TEST(SearchDrives, RoughModelIsThatOfTheVehicle) {
  const StrutModel rough = roughModel({samplesOf(drive(healthyDrive()))}, options());
  EXPECT_TRUE(isDampedSpring(rough));
  EXPECT_NEAR(rough.damping_to_mass, 3.0, 0.03);
  EXPECT_NEAR(rough.stiffness_to_mass, 13.8, 0.14);
}

TEST(SearchDrives, NoRowOfTheRoughModelSpansTwoDrivesOrAGap) {
  // The second drive's readings are offset alike: a row that spanned the step would see a jump of 100 m/s^2.
  const std::vector<DriveSample> simulated = drive(healthyDrive());
  DriveSamples first = samplesOf(simulated), second = samplesOf(simulated, std::chrono::seconds(100));
  for (CornerSample& sample : second) {
    sample.sprung_acceleration += 100.0;
    sample.unsprung_acceleration += 100.0;
  }
  DriveSamples joined = first;
  joined.insert(joined.end(), second.begin(), second.end());
  const StrutModel alone = roughModel({first}, options());
  for (const StrutModel& rough : {roughModel({first, second}, options()), roughModel({joined}, options())}) {
    EXPECT_NEAR(rough.damping_to_mass, alone.damping_to_mass, 1e-3 * alone.damping_to_mass);
    EXPECT_NEAR(rough.stiffness_to_mass, alone.stiffness_to_mass, 1e-3 * alone.stiffness_to_mass);
  }
}

TEST(SearchDrives, NothingThatMovesIsNoStrut) {
  DriveSamples parked;
  for (int i = 0; i < 500; ++i) parked.push_back({fromSeconds(kPeriod * i), 9.81, 9.81});
  EXPECT_FALSE(isDampedSpring(roughModel({parked}, options())));
  EXPECT_FALSE(isDampedSpring(roughModel({{}}, options())));
}

TEST(SearchDrives, EveryDriveIsARecordInStepsThatTheStrutNeeds) {
  const DriveSamples samples = samplesOf(drive(healthyDrive()));
  const StrutModel slow{3.0, 13.8, {}, {}}, fast{3.0, 1e4, {}, {}};
  const std::deque<DriveRecord> records = makeRecords({samples, samples}, kPeriod, slow);
  ASSERT_EQ(pointersTo(records).size(), 2U);
  EXPECT_EQ(pointersTo(records)[1], &records[1]);
  EXPECT_EQ(records[0].numSamples(), records[1].numSamples());
  EXPECT_GT(records[0].numSamples(), 2900U);
  EXPECT_EQ(records[0].steps(), 1);
  EXPECT_EQ(makeRecords({samples}, kPeriod, fast).front().steps(), 6);  // 0.02 s * 100 1/s / 0.35
}

TEST(MotionScale, IsTheMotionOfTheStrut) {
  const std::vector<DriveSample> simulated = drive(healthyDrive());
  double travel = 0.0, rate = 0.0;
  for (const DriveSample& sample : simulated) {
    travel += sample.truth.travel * sample.truth.travel;
    rate += sample.truth.travel_rate * sample.truth.travel_rate;
  }
  const auto rms = [&](double sum) { return std::sqrt(sum / static_cast<double>(simulated.size())); };
  const std::optional<MotionScale> scale = motionScale(samplesOf(simulated), kPeriod, 3.0, 13.8);
  ASSERT_TRUE(scale);
  EXPECT_NEAR(scale->unit(ShapeScale::kTravel), rms(travel), 0.1 * rms(travel));
  EXPECT_NEAR(scale->unit(ShapeScale::kTravelRate), rms(rate), 0.1 * rms(rate));
  EXPECT_NEAR(scale->unit(ShapeScale::kTime), 1.0 / std::sqrt(13.8), 1e-12);
  EXPECT_EQ(scale->unit(ShapeScale::kNone), 1.0);
}

TEST(MotionScale, CannotBeToldWithoutAStrutOrMotion) {
  const DriveSamples samples = samplesOf(drive(healthyDrive()));
  DriveSamples parked = samples;
  for (CornerSample& sample : parked) sample.sprung_acceleration = sample.unsprung_acceleration = 0.0;
  EXPECT_FALSE(motionScale(samples, kPeriod, std::nan(""), std::nan("")));
  EXPECT_FALSE(motionScale(samples, kPeriod, 3.0, -13.8));
  EXPECT_FALSE(motionScale(parked, kPeriod, 3.0, 13.8));
  EXPECT_FALSE(motionScale({samples.begin(), samples.begin() + 20}, kPeriod, 3.0, 13.8));
}

}  // namespace
}  // namespace suspension_health_monitor
