#include "suspension_health_monitor/internal/health/sensor_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

using Change = std::function<void(double& sprung, double& unsprung)>;

/// @return what is said of the sensors after a drive of 60 s whose readings are changed.
/// @param gravity  that both of them read [m/s^2].
/// @param settings  of the monitor, but for the sample period.
SensorFault faultOf(SimulationOptions options, double gravity, const Change& change, MonitorSettings settings = {}) {
  options.duration = 60.0;
  options.rate = 100.0;
  settings.sample_period = 0.01;
  SuspensionMonitor monitor(settings);
  for (const DriveSample& sample : drive(options)) {
    double sprung = gravity + sample.sprung->acceleration, unsprung = gravity + sample.unsprung->acceleration;
    change(sprung, unsprung);
    monitor.addSample({sample.stamp, sprung, unsprung});
  }
  return monitor.report().health.sensor.fault;
}

SimulationOptions road(const std::string& vehicle) {
  SimulationOptions options = scenario("iso_road");
  options.vehicle = vehicle;
  return options;
}

const Change kSwap = [](double& sprung, double& unsprung) { std::swap(sprung, unsprung); };
const Change kTurnBody = [](double& sprung, double&) { sprung = -sprung; };
const Change kTurnWheel = [](double&, double& unsprung) { unsprung = -unsprung; };

TEST(SensorCheck, SuspectsSensorsThatAreSwapped) {
  for (const double gravity : {0.0, 9.81})
    EXPECT_EQ(faultOf(road("ugv"), gravity, kSwap), SensorFault::kUnrelated) << gravity;
}

TEST(SensorCheck, NamesASensorThatIsUpsideDown) {
  for (const Change& turn : {kTurnBody, kTurnWheel}) {
    for (const double gravity : {0.0, 9.81})
      EXPECT_EQ(faultOf(road("ugv"), gravity, turn), SensorFault::kNegativeDamping) << gravity;
  }
}

TEST(SensorCheck, NamesASensorThatReadsInG) {
  EXPECT_EQ(faultOf(road("ugv"), 9.81, [](double& sprung, double&) { sprung /= 9.81; }), SensorFault::kInG);
  EXPECT_EQ(faultOf(road("ugv"), 9.81, [](double&, double& unsprung) { unsprung /= 9.81; }), SensorFault::kInG);
}

TEST(SensorCheck, SuspectsNothingInHealthyDrives) {
  const Change none = [](double&, double&) {};
  for (const double gravity : {0.0, 9.81, -9.81}) {
    for (const char* vehicle : {"golden_car", "rover", "ugv"})
      EXPECT_EQ(faultOf(road(vehicle), gravity, none), SensorFault::kNone) << vehicle << " " << gravity;
    for (const char* name : {"paper_clean", "paper_outliers", "paper_saturation"})
      EXPECT_EQ(faultOf(scenario(name), gravity, none), SensorFault::kNone) << name << " " << gravity;
  }
}

// A mean over less than a sample, and over a few, is none.
TEST(SensorCheck, SuspectsNothingWithAShortWindowOrALongHorizon) {
  const Change none = [](double&, double&) {};
  MonitorSettings settings;
  for (const double window : {0.001, 0.1, 0.3, 1.0, 3.0}) {
    settings.comparison_window = window;
    for (const double gravity : {0.0, 9.81})
      EXPECT_EQ(faultOf(scenario("paper_clean"), gravity, none, settings), SensorFault::kNone) << window;
  }
  settings.comparison_window = 1.0;
  settings.integration_horizon = 3.0;
  EXPECT_EQ(faultOf(scenario("paper_clean"), 0.0, none, settings), SensorFault::kNone);
}

// Of a dead gyro, or a position that is wrong: what is given as a top's motion is not what moved there.
TEST(SensorCheck, AccusesNoSensorOfAStrutWhereTheVehicleFileIsContradicted) {
  SimulationOptions options = road("ugv");
  options.duration = 60.0;
  options.rate = 100.0;
  for (const EstimateDoubt doubt : {EstimateDoubt::kVehicleFile, EstimateDoubt::kNotExplained}) {
    StrutEstimate estimate, la;
    estimate.doubt = doubt;
    SensorCheck check(500.0, 40);
    for (const DriveSample& sample : drive(options)) {
      check.add({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
      check.judge(estimate, la, true);
    }
    const bool is_known = doubt == EstimateDoubt::kVehicleFile;
    EXPECT_EQ(check.report().fault, is_known ? SensorFault::kNone : SensorFault::kUnrelated);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
