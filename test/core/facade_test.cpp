// diagnose() and compare() over arrays: what they take and refuse. What they find is tested behind them.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "body_drive.h"
#include "hidden_effect.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {
namespace {

Drive driveOf(const SimulationOptions& options) {
  Drive result;
  for (const DriveSample& sample : drive(options))
    result.samples.push_back({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
  return result;
}

const Drive& carWithAStop() {
  static const Drive result = [] {
    SimulationOptions options = carDrive(60.0, 0.03);
    options.hidden = {hiddenEffect(options, "bump_stop", {0.012}, 0.15)};
    return driveOf(options);
  }();
  return result;
}

DiagnoseOptions quick() {
  DiagnoseOptions options;
  options.candidates = {{findEffect(forceEffects(), "bump_stop"), findEffect(forceEffects(), "asymmetric_damping")},
                        builtInEffects().readings};
  options.most_effects = 1;
  return options;
}

TEST(Facade, ArraysAloneAreEnough) {
  const Diagnosis found = diagnose({carWithAStop()}, quick());
  ASSERT_TRUE(found) << found.reason;
  EXPECT_EQ(found.selected, std::vector<std::string>{"bump_stop"});
  EXPECT_EQ(found.summary, "Missing from the model: bump_stop.");
  EXPECT_EQ(found.final_fit->stddev.size(), numbersOf(found.model()).size());
  EXPECT_EQ(found.to - found.from, carWithAStop().samples.back().stamp - carWithAStop().samples.front().stamp);
  ASSERT_EQ(found.not_tried.size(), 2u);  // the IMU's faults that need its other axes
  EXPECT_EQ(found.not_tried[0].first, "mount_tilt");
  EXPECT_NE(found.not_tried[0].second.find("acceleration across"), std::string::npos);
}

TEST(Facade, EmptyDrivesBesideAGoodOneChangeNothing) {
  const Diagnosis found = diagnose({Drive{}, carWithAStop(), Drive{}}, quick());
  ASSERT_TRUE(found) << found.reason;
  EXPECT_EQ(found.selected, std::vector<std::string>{"bump_stop"});
  EXPECT_EQ(found.from, carWithAStop().samples.front().stamp);
  EXPECT_EQ(found.to, carWithAStop().samples.back().stamp);
}

TEST(Facade, NoDriveIsNoEstimateWhereAllIsGiven) {
  IdentifyOptions options;
  options.sample_period = 0.01;
  options.horizon_samples = 50;
  for (const std::vector<Drive>& nothing : {std::vector<Drive>{}, std::vector<Drive>{Drive{}}})
    EXPECT_FALSE(identify(nothing, options).estimate.valid());
}

TEST(Facade, RefusesAModelOfMoreEffectsThanThereMayBe) {
  CompareOptions options;
  const ActiveEffect stop{findEffect(forceEffects(), "bump_stop"), 40.0, {0.012}};
  options.model = StrutModel{6.0, 63.3, std::vector<ActiveEffect>(kMostEffects + 1, stop), {}};
  EXPECT_THROW(compare({carWithAStop()}, options), std::invalid_argument);
}

TEST(Facade, BothSayTheSameOfTheNoiseAndOfWhatIsStructure) {
  for (const Drive& drive : {carWithAStop(), driveOf(carDrive(60.0, 0.03))}) {
    const Diagnosis found = diagnose({drive}, quick());
    const Comparison linear = compare({drive});
    ASSERT_TRUE(found && linear);
    // The same estimate; the search has models that leave less, and nothing leaves less than the noise.
    EXPECT_LE(found.noise_floor, 1.02 * linear.noise_floor);  // bounded by another fit
    EXPECT_GT(found.noise_floor, 0.85 * linear.noise_floor);
    EXPECT_EQ(found.verdict == Verdict::kNothingMissing, linear.where[0].view == FailureView::kNone);
  }
}

TEST(Facade, TheModelGivenStaysAndIsJudgedAsItIs) {
  StrutModel model{6.0, 63.3, {{findEffect(forceEffects(), "bump_stop"), 40.0, {0.012}}}, {}};
  CompareOptions as_given;
  as_given.model = model;
  as_given.fit = false;
  const Comparison comparison = compare({carWithAStop()}, as_given);
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison.model.damping_to_mass, 6.0);
  EXPECT_EQ(comparison.forces.size(), 1u);
  DiagnoseOptions options = quick();
  options.model = model;
  const Diagnosis beside = diagnose({carWithAStop()}, options);
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside.verdict, Verdict::kNothingMissing);
  EXPECT_EQ(beside.base.effects, std::vector<std::string>{"bump_stop"});
}

TEST(Facade, DrivesThatSayNothingAreAResultWithAReason) {
  const std::vector<double> still(4000, 9.81);
  const Drive parked = makeDrive(0.01, still, still), brief = driveOf(carDrive(3.0, 0.03));
  EXPECT_EQ(diagnose({parked}).shortcoming, Shortcoming::kNoDampedSpring);
  EXPECT_EQ(compare({parked}).shortcoming, Shortcoming::kNoDampedSpring);
  EXPECT_NE(compare({parked}).reason.find("no damped spring"), std::string::npos);
  DiagnoseOptions options;
  options.horizon_samples = 20;
  EXPECT_EQ(diagnose({brief}, options).shortcoming, Shortcoming::kTooShort);
  options.model = StrutModel{6.0, 1e9, {}, {}};
  EXPECT_EQ(diagnose({carWithAStop()}, options).shortcoming, Shortcoming::kTooFast);
  options.model = StrutModel{6.0, 63.3, {}, {fault("mount_tilt", {0.1, 0.0})}};
  const Diagnosis untestable = diagnose({carWithAStop()}, options);
  EXPECT_EQ(untestable.shortcoming, Shortcoming::kModelUntestable);
  EXPECT_NE(untestable.reason.find("mount_tilt"), std::string::npos) << untestable.reason;
}

TEST(Facade, WrongOptionsAreRefused) {
  DiagnoseOptions options;
  EXPECT_THROW(diagnose({}, options), std::invalid_argument);
  EXPECT_THROW(diagnose({Drive{}}, options), std::invalid_argument);  // no period to measure
  options.sample_period = -0.01;
  EXPECT_THROW(diagnose({carWithAStop()}, options), std::invalid_argument);
  options = {};
  options.threads = 0;
  EXPECT_THROW(diagnose({carWithAStop()}, options), std::invalid_argument);
  Drive filtered = carWithAStop();
  const std::vector<double> unfiltered(filtered.samples.size());
  for (const LowPass& low_pass :
       {LowPass{{0.5, 0.5}, unfiltered}, LowPass{{1.0}, {}}, LowPass{{}, unfiltered}, LowPass{{1.0}, {1.0, 2.0}}}) {
    filtered.low_pass = low_pass;
    EXPECT_THROW(diagnose({filtered}), std::invalid_argument);
    EXPECT_THROW(diagnoseVehicle({{{filtered, filtered}}}, {"front", "rear"}), std::invalid_argument);
  }
  EXPECT_THROW(makeDrive(0.01, {1.0, 2.0}, {1.0}), std::invalid_argument);
  EXPECT_THROW(makeDrive(0.0, {1.0}, {1.0}), std::invalid_argument);
}

TEST(Facade, ProgressCanCancel) {
  struct Enough {};
  CompareOptions comparing;
  comparing.progress = [](double) { throw Enough(); };
  EXPECT_THROW(compare({carWithAStop()}, comparing), Enough);
  DiagnoseOptions searching = quick();
  searching.progress = comparing.progress;
  EXPECT_THROW(diagnose({carWithAStop()}, searching), Enough);
}

TEST(MedianPeriod, IsThatOfTheStampsWhateverIsMissing) {
  Drive gappy = makeDrive(0.01, std::vector<double>(100, 0.0), std::vector<double>(100, 0.0));
  gappy.samples.erase(gappy.samples.begin() + 20, gappy.samples.begin() + 50);
  EXPECT_NEAR(medianPeriod({gappy, {}}), 0.01, 1e-12);
}

}  // namespace
}  // namespace suspension_health_monitor
