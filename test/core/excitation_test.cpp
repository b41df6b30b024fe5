// Forgetting only where there is information: parked for a day, driven on.
#include "suspension_health_monitor/internal/identification/excitation.h"

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

constexpr int kDay = 24 * 3600;  // rows, at one a second instead of 50: the law counts rows

void expectTrue(const StrutEstimate& estimate) {
  EXPECT_NEAR(estimate.damping_to_mass, kB1, 0.2);
  EXPECT_NEAR(estimate.stiffness_to_mass, kB0, 0.6);
}

TEST(Excitation, OfAParkedVehicleIsNoneSoThatADayChangesNothingAndTheNextDriveIsRightAtOnce) {
  DrivenStrut strut(liveOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  ASSERT_TRUE(strut.la().valid());
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));  // it stops within 3 s and rests
  const StrutEstimate ls = strut.ls(), la = strut.la();
  EXPECT_EQ(la.doubt, EstimateDoubt::kNotExcited);
  EXPECT_LT(la.damping_excitation, 4.5);
  expectTrue(ls);
  expectTrue(la);
  EXPECT_GE(strut.park(kDay), kDay * 0.999);
  EXPECT_NEAR(strut.la().damping_to_mass, la.damping_to_mass, la.damping_to_mass_stddev);
  EXPECT_NEAR(strut.la().stiffness_to_mass, la.stiffness_to_mass, la.stiffness_to_mass_stddev);
  EXPECT_NEAR(strut.ls().damping_to_mass, ls.damping_to_mass, ls.damping_to_mass_stddev);
  EXPECT_NEAR(strut.ls().stiffness_to_mass, ls.stiffness_to_mass, ls.stiffness_to_mass_stddev);
  EXPECT_LT(strut.la().damping_to_mass_stddev, 2.0 * la.damping_to_mass_stddev);
  EXPECT_FALSE(strut.la().valid());
  const auto road = roadBetween(strut.time(), 1e9);
  for (int k = 0; k < 40; ++k) {  // 20 s
    strut.drive(25, road);
    expectTrue(strut.la());
  }
  EXPECT_TRUE(strut.la().valid());
  EXPECT_EQ(strut.la().doubt, EstimateDoubt::kNone);
}

// In 5.5 hours at rest there are 15 000 blocks in which noise may look like a road by chance.
TEST(Excitation, HoursAfterAStopOnThePapersRoadTheEstimatesAreWhatTheyWere) {
  for (const double brake : {0.3, 3.0}) {
    DrivenStrut strut(liveOptions());
    const auto road = [wheel = brakedPaperRoad(57.0, brake)](double t) { return wheel(t).height; };
    strut.drive(static_cast<int>((57.0 + brake) / kPeriod), road);
    const StrutEstimate stop = strut.la();
    ASSERT_TRUE(stop.valid()) << brake;
    strut.drive(500, road);
    EXPECT_EQ(strut.la().doubt, EstimateDoubt::kNotExcited) << brake;
    constexpr int kHours = 1000000;
    EXPECT_EQ(strut.park(kHours), kHours) << brake;
    EXPECT_NEAR(strut.la().damping_to_mass, stop.damping_to_mass, 0.02 * stop.damping_to_mass) << brake;
    EXPECT_NEAR(strut.la().stiffness_to_mass, stop.stiffness_to_mass, 0.02 * stop.stiffness_to_mass) << brake;
    EXPECT_LT(strut.la().stiffness_to_mass_stddev, 0.1 * kB0) << brake;
  }
}

// One of a hundred times the noise every 20 s, on either side.
TEST(Excitation, WrongReadingsAtRestChangeNothing) {
  for (const bool of_body : {true, false}) {
    DrivenStrut strut(liveOptions());
    strut.drive(2000, roadBetween(0.0, 1e9));
    strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
    const StrutEstimate la = strut.la();
    ASSERT_EQ(la.doubt, EstimateDoubt::kNotExcited);
    for (int k = 0; k < 20; ++k) {
      strut.read(of_body ? 10.0 : 0.0, of_body ? 0.0 : 10.0);
      EXPECT_EQ(strut.park(1000), 1000);
    }
    EXPECT_EQ(strut.la().damping_to_mass, la.damping_to_mass);
    EXPECT_EQ(strut.la().stiffness_to_mass, la.stiffness_to_mass);
  }
}

TEST(Excitation, OfAnEngineThatIdlesIsNone) {
  DrivenStrut strut(liveOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
  const StrutEstimate la = strut.la();
  // That it starts to shake may be a road for two blocks.
  for (const double frequency : {3.0, 12.0, 22.0})
    EXPECT_GE(strut.idle(5000, 0.5, frequency), 5000 - 2 * 64) << frequency;
  EXPECT_NEAR(strut.la().damping_to_mass, la.damping_to_mass, 0.02 * kB1);
  EXPECT_NEAR(strut.la().stiffness_to_mass, la.stiffness_to_mass, 0.02 * kB0);
}

// Ten times: is right in the second half of every drive.
TEST(Excitation, StopAndGoEveryTenSeconds) {
  DrivenStrut strut(liveOptions());
  strut.drive(2000, roadBetween(0.0, 1e9));
  for (int k = 0; k < 10; ++k) {
    strut.park(500);
    EXPECT_EQ(strut.la().doubt, EstimateDoubt::kNotExcited) << k;
    const double start = strut.time();
    const auto road = roadBetween(start, start + 10.0);
    strut.drive(250, road);
    strut.drive(150, road);
    EXPECT_TRUE(strut.la().valid()) << k;
    expectTrue(strut.la());
    strut.drive(100, road);
  }
}

// A drive of the strut b1, b0 on the paper's road, `smoother` times as smooth.
void follow(SuspensionMonitor& monitor, Stamp& stamp, double b1, double b0, double smoother, int& held) {
  SimulationOptions options;
  options.damping_end_fraction = 1.0;
  options.damping_to_mass = b1;
  options.stiffness_to_mass = b0;
  options.duration = 60.0;
  options.noise = 0.0;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, 0.024);
  for (const CornerSample& sample : simulate(options)) {
    stamp += std::chrono::milliseconds(20);
    monitor.addSample({stamp, sample.sprung_acceleration / smoother + noise(engine),
                       sample.unsprung_acceleration / smoother + noise(engine)});
    const EstimateDoubt doubt = monitor.report().la.doubt;
    held += doubt == EstimateDoubt::kNotExcited || doubt == EstimateDoubt::kDampingNotExcited ||
                    doubt == EstimateDoubt::kStiffnessNotExcited
                ? 1
                : 0;
  }
}

TEST(Excitation, OfAStrutThatBreaksAsTheRoadGetsSmootherGoesOn) {
  struct Broken {
    double b1, b0;
  };
  for (const Broken broken : {Broken{0.3, kB0}, {kB1, 0.5 * kB0}, {0.3, 0.5 * kB0}}) {
    SuspensionMonitor monitor(liveOptions());
    Stamp stamp{};
    int held = 0;
    follow(monitor, stamp, kB1, kB0, 1.0, held);
    follow(monitor, stamp, broken.b1, broken.b0, 5.0, held);
    EXPECT_LT(held, 300) << broken.b1 << ", " << broken.b0;
    EXPECT_NEAR(monitor.report().la.damping_to_mass, broken.b1, 0.25);
    EXPECT_NEAR(monitor.report().la.stiffness_to_mass, broken.b0, 0.8);
  }
}

// What b1 makes of phi_1 is a sixth of the residual there.
TEST(Excitation, OfALightlyDampedStrutOnASmootherRoadGoesOn) {
  const double b1 = 2.0 * 0.02 * std::sqrt(kB0);
  SuspensionMonitor monitor(liveOptions());
  Stamp stamp{};
  int held = 0;
  follow(monitor, stamp, b1, kB0, 1.0, held);
  follow(monitor, stamp, b1, kB0, 10.0, held);
  EXPECT_EQ(held, 0);
}

TEST(Excitation, ExponentialForgettingLosesTheParkedStrut) {
  MonitorSettings options = liveOptions();
  options.estimators.forgets_unexcited = true;
  DrivenStrut strut(options);
  strut.drive(2000, roadBetween(0.0, 1e9));
  strut.drive(500, roadBetween(-1e9, strut.time() + 3.0));
  strut.park(10000);
  EXPECT_GT(std::abs(strut.la().stiffness_to_mass - kB0), 3.0);
}

}  // namespace
}  // namespace suspension_health_monitor
