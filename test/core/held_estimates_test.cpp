// What is known of a strut is held while nothing is told of it, and then is old: parked for hours, driven on.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "braked_road.h"
#include "driven_strut.h"
#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr int kSecond = 50;  // rows

void expectTrue(const StrutEstimate& estimate) {
  EXPECT_NEAR(estimate.damping_to_mass, kB1, 0.2);
  EXPECT_NEAR(estimate.stiffness_to_mass, kB0, 0.6);
}

// By the standard deviations that prove a change.
void expectWithinStddevs(const StrutEstimate& estimate) {
  EXPECT_NEAR(estimate.damping_to_mass, kB1, 4.0 * estimate.damping_to_mass_stddev);
  EXPECT_NEAR(estimate.stiffness_to_mass, kB0, 4.0 * estimate.stiffness_to_mass_stddev);
}

void expectSame(const StrutEstimate& now, const StrutEstimate& before) {
  EXPECT_EQ(now.damping_to_mass, before.damping_to_mass);
  EXPECT_EQ(now.stiffness_to_mass, before.stiffness_to_mass);
}

/// A strut that has driven for 40 s, stopped within 3 s and rested until 10 s are over.
DrivenStrut parkedStrut(const MonitorSettings& options) {
  DrivenStrut strut(options);
  strut.drive(2000, roadBetween(0.0, 1e9));
  EXPECT_TRUE(strut.estimate().valid() && strut.la().valid());
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
  return strut;
}

MonitorSettings judgedOptions() {
  MonitorSettings options = liveOptions();
  options.nominal_damping_to_mass = kB1;
  options.nominal_stiffness_to_mass = kB0;
  return options;
}

// Blocks whose information is on average 60 s old when the strut has stood for that long less half of their span, and
// more: of the newest blocks that tell of the strut, those of the drive tell most.
TEST(HeldEstimate, OfAParkedVehicleIsJudgedUntilItIsOldAndThenStale) {
  DrivenStrut strut = parkedStrut(judgedOptions());
  EXPECT_EQ(strut.health().level, HealthLevel::kOk);
  double valid_until = 0.0;
  for (int second = 0; second < 120; ++second) {
    strut.park(kSecond);
    EXPECT_EQ(strut.estimate().valid(), strut.estimate().age <= 60.0) << second;
    if (strut.estimate().valid()) {
      EXPECT_EQ(strut.health().level, HealthLevel::kOk) << second;
      valid_until = second;
    }
  }
  EXPECT_GT(valid_until, 40.0);
  EXPECT_LT(valid_until, 60.0);
  EXPECT_EQ(strut.estimate().doubt, EstimateDoubt::kOldData);
  EXPECT_EQ(strut.la().doubt, EstimateDoubt::kDisagrees);
  EXPECT_EQ(strut.health().level, HealthLevel::kStale);
}

TEST(HeldEstimate, OfAParkedVehicleIsNotChangedByADayAndTheNextDriveIsRightAtOnce) {
  constexpr int kDay = 24 * 3600;  // rows, at one a second instead of 50: blocks and rows are counted, not seconds
  DrivenStrut strut = parkedStrut(liveOptions());
  const StrutEstimate held = strut.estimate(), ls = strut.ls(), la = strut.la();
  expectWithinStddevs(held);
  for (const StrutEstimate& estimate : {ls, la}) expectTrue(estimate);
  strut.park(kDay);
  for (const auto& [now, before] : {std::pair(strut.estimate(), held), {strut.ls(), ls}, {strut.la(), la}}) {
    EXPECT_NEAR(now.damping_to_mass, before.damping_to_mass, before.damping_to_mass_stddev);
    EXPECT_NEAR(now.stiffness_to_mass, before.stiffness_to_mass, before.stiffness_to_mass_stddev);
  }
  EXPECT_FALSE(strut.estimate().valid());
  EXPECT_FALSE(strut.la().valid());
  const auto road = roadBetween(strut.time(), 1e9);
  for (int k = 0; k < 40; ++k) {  // 20 s
    strut.drive(kSecond / 2, road);
    if (strut.la().valid()) expectTrue(strut.la());
    if (strut.estimate().valid()) expectWithinStddevs(strut.estimate());
  }
  EXPECT_TRUE(strut.estimate().valid());
  EXPECT_TRUE(strut.la().valid());
}

// In 2.2 hours at rest there are 8000 blocks in which noise may look like a road by chance; how it came to rest is
// forgotten within minutes, of which 17 are enough for the other stop.
TEST(HeldEstimate, HoursAfterAStopOnThePapersRoadItIsWhatItWas) {
  for (const double brake : {0.3, 3.0}) {
    DrivenStrut strut(liveOptions());
    const auto road = [wheel = brakedPaperRoad(57.0, brake)](double t) { return wheel(t).height; };
    strut.drive(static_cast<int>((57.0 + brake) / kPeriod), road);
    const StrutEstimate stop = strut.la();
    ASSERT_TRUE(stop.valid()) << brake;
    strut.drive(500, road);
    strut.park(brake > 1.0 ? 400000 : 50000);
    EXPECT_EQ(strut.estimate().doubt, EstimateDoubt::kOldData) << brake;
    expectWithinStddevs(strut.estimate());
    const StrutEstimate& la = strut.la();
    // The newest blocks tell something of the strut until all of them are at rest: rows of two memories are.
    EXPECT_NEAR(la.damping_to_mass, stop.damping_to_mass, 3.0 * la.damping_to_mass_stddev) << brake;
    EXPECT_NEAR(la.stiffness_to_mass, stop.stiffness_to_mass, 3.0 * la.stiffness_to_mass_stddev) << brake;
    EXPECT_LT(strut.la().stiffness_to_mass_stddev, 0.15 * kB0) << brake;
  }
}

// One of a hundred times the noise every 20 s, on either side.
TEST(HeldEstimate, IsNotChangedByWrongReadingsAtRest) {
  for (const bool of_body : {true, false}) {
    DrivenStrut strut = parkedStrut(liveOptions());
    strut.park(140 * kSecond);  // of the newest 64 blocks, which begin every 2 s, none is of the drive
    const StrutEstimate held = strut.estimate(), la = strut.la();
    for (int k = 0; k < 20; ++k) {
      strut.read(of_body ? 10.0 : 0.0, of_body ? 0.0 : 10.0);
      strut.park(1000);
    }
    expectSame(strut.estimate(), held);
    expectSame(strut.la(), la);
  }
}

TEST(HeldEstimate, IsNotChangedByAnEngineThatIdles) {
  DrivenStrut strut = parkedStrut(liveOptions());
  const StrutEstimate la = strut.la();
  for (const double frequency : {3.0, 12.0, 22.0}) {
    strut.idle(5000, 0.5, frequency);
    EXPECT_TRUE(!strut.estimate().valid() || std::abs(strut.estimate().stiffness_to_mass / kB0 - 1.0) < 0.02)
        << frequency;
  }
  EXPECT_EQ(strut.estimate().doubt, EstimateDoubt::kOldData);
  EXPECT_NEAR(strut.la().damping_to_mass, la.damping_to_mass, 0.02 * kB1);
  EXPECT_NEAR(strut.la().stiffness_to_mass, la.stiffness_to_mass, 0.02 * kB0);
}

// Ten times: is right at every moment.
TEST(HeldEstimate, StopAndGoEveryTenSeconds) {
  DrivenStrut strut(liveOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  for (int k = 0; k < 10; ++k) {
    strut.park(500);
    const double start = strut.time();
    const auto road = roadBetween(start, start + 10.0);
    for (int part = 0; part < 10; ++part) {
      strut.drive(50, road);
      EXPECT_TRUE(strut.estimate().valid()) << k;
      expectTrue(strut.estimate());
    }
    expectTrue(strut.la());
  }
}

// A drive of the strut b1, b0 on the paper's road, `smoother` times as smooth.
// @return seconds in which a valid estimate is more than 4 standard deviations from the strut, or there is none.
double follow(SuspensionMonitor& monitor, Stamp& stamp, double b1, double b0, double smoother) {
  SimulationOptions options;
  options.damping_end_fraction = 1.0;
  options.damping_to_mass = b1;
  options.stiffness_to_mass = b0;
  options.duration = 60.0;
  options.noise = 0.0;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, 0.024);
  double wrong = 0.0;
  for (const CornerSample& sample : simulate(options)) {
    stamp += std::chrono::milliseconds(20);
    monitor.addSample({stamp, sample.sprung_acceleration / smoother + noise(engine),
                       sample.unsprung_acceleration / smoother + noise(engine)});
    const StrutEstimate& estimate = monitor.report().estimate;
    const bool is_right = std::abs(estimate.damping_to_mass - b1) < 4.0 * estimate.damping_to_mass_stddev &&
                          std::abs(estimate.stiffness_to_mass - b0) < 4.0 * estimate.stiffness_to_mass_stddev;
    wrong += estimate.valid() && is_right ? 0.0 : 0.02;
  }
  return wrong;
}

TEST(Estimate, FollowsAStrutThatBreaksAsTheRoadGetsSmoother) {
  struct Broken {
    double b1, b0;
  };
  for (const Broken broken : {Broken{0.3, kB0}, {kB1, 0.5 * kB0}, {0.3, 0.5 * kB0}}) {
    SCOPED_TRACE(std::to_string(broken.b1) + ", " + std::to_string(broken.b0));
    SuspensionMonitor monitor(liveOptions());
    Stamp stamp{};
    follow(monitor, stamp, kB1, kB0, 1.0);
    // Three blocks of 4 s which overlap by half span 8 s; one or two more are of both struts.
    EXPECT_LT(follow(monitor, stamp, broken.b1, broken.b0, 5.0), 12.0);
    const StrutEstimate& estimate = monitor.report().estimate;
    EXPECT_NEAR(estimate.damping_to_mass, broken.b1, 0.25);
    EXPECT_NEAR(estimate.stiffness_to_mass, broken.b0, 0.8);
    EXPECT_NEAR(monitor.report().la.damping_to_mass, broken.b1, 0.25);
    EXPECT_NEAR(monitor.report().la.stiffness_to_mass, broken.b0, 0.8);
  }
}

// What b1 makes of phi_1 is a sixth of the residual there.
TEST(Estimate, FollowsALightlyDampedStrutOnASmootherRoad) {
  const double b1 = 2.0 * 0.02 * std::sqrt(kB0);
  SuspensionMonitor monitor(liveOptions());
  Stamp stamp{};
  follow(monitor, stamp, b1, kB0, 1.0);
  EXPECT_LT(follow(monitor, stamp, b1, kB0, 10.0), 6.0);
  EXPECT_NEAR(monitor.report().estimate.stiffness_to_mass, kB0, 0.8);
}

TEST(HeldEstimate, OfThePapersPresetIsNoneRowsOfAParkedStrutAreForgottenBy) {
  DrivenStrut strut(paperOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
  strut.park(10000);
  EXPECT_GT(std::abs(strut.la().stiffness_to_mass - kB0), 3.0);
}

}  // namespace
}  // namespace suspension_health_monitor
