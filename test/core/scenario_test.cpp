#include "suspension_health_monitor/internal/simulation/scenario.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "quarter_car.h"
#include "simulated_drive.h"

namespace suspension_health_monitor {
namespace {

TEST(VehicleStrut, IsPushedAwayFromItsEndStops) {
  VehicleStrut strut;
  strut.stop_gap = 0.09;
  strut.stop_stiffness_to_mass = 1000.0;
  EXPECT_DOUBLE_EQ(strut.stopForceToMass(0.05), 0.0);
  EXPECT_NEAR(strut.stopForceToMass(0.10), 10.0, 1e-12);
  EXPECT_NEAR(strut.stopForceToMass(-0.11), -20.0, 1e-12);
}

TEST(QuarterCarOf, VehiclesHaveTheirPublishedRatios) {
  SimulationOptions options = scenario("iso_road", 0.0);
  const QuarterCar golden = carOf(options);
  EXPECT_NEAR(golden.dampingToMass(), 6.0, 1e-12);
  EXPECT_NEAR(golden.stiffnessToMass(), 63.3, 1e-12);
  EXPECT_NEAR(golden.unsprung_mass / golden.sprung_mass, 0.15, 1e-12);
  EXPECT_NEAR(*golden.tyre_stiffness / golden.sprung_mass, 653.0, 1e-9);
  options.vehicle = "rover";
  options.damping_to_mass = 7.0;
  options.stiffness_to_mass = 90.0;
  const DriveTruth truth = drive(options).front().truth;
  EXPECT_NEAR(truth.damping_to_mass, 7.0, 1e-12);
  EXPECT_NEAR(truth.stiffness_to_mass, 90.0, 1e-12);
}

TEST(QuarterCarOf, VehiclesHaveTheirOwnRoadAndSpeedUnlessToldOtherwise) {
  SimulationOptions options = scenario("iso_road", 0.0);
  options.vehicle = "rover";
  const RoadPoint own = roadOf(options)(3.0);
  options.iso_class = "E";
  options.speed = 2.0;
  EXPECT_EQ(roadOf(options)(3.0).height, own.height);
  options.iso_class = "F";
  EXPECT_NEAR(roadOf(options)(3.0).height, 2.0 * own.height, 1e-12);
  options.speed = 6.0;
  EXPECT_NEAR(roadOf(options)(1.0).height, 2.0 * own.height, 1e-12);
}

TEST(SimulationOptions, AreRefusedByNameAndValue) {
  const auto complaint = [](auto change) -> std::string {
    SimulationOptions options;
    change(options);
    try {
      DriveSimulator simulator(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const auto expectWords = [](const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << "got: " << message;
  };
  expectWords(complaint([](SimulationOptions& o) { o.scenario = "paper"; }), "scenario = \"paper\"");
  expectWords(complaint([](SimulationOptions& o) { o.iso_class = "I"; }), "iso_class = \"I\"");
  expectWords(complaint([](SimulationOptions& o) { o.rate = -50.0; }), "rate = -50");
  expectWords(complaint([](SimulationOptions& o) { o.noise = std::nan(""); }), "noise = nan");
  expectWords(complaint([](SimulationOptions& o) { o.stamp_jitter = 0.02; }), "stamp_jitter = 0.02");
  expectWords(complaint([](SimulationOptions& o) { o.ramp_end = 30.0; }), "ramp_end = 30");
  expectWords(complaint([](SimulationOptions& o) { o.speed = 0.0; }), "speed = 0");
}

TEST(SimulationOptions, DefaultsAreValidAndValuesAreTakenByName) {
  SimulationOptions options;
  EXPECT_NO_THROW(validate(options));
  OptionMap values{{"scenario", "iso_road"}, {"seed", 7}, {"damping_end_fraction", 1}, {"speed", 3}};
  takeOptions(values, kSimulationFields, options);
  EXPECT_TRUE(values.empty());
  EXPECT_EQ(options.scenario, "iso_road");
  EXPECT_EQ(options.seed, 7);
  EXPECT_DOUBLE_EQ(*options.damping_end_fraction, 1.0);
  EXPECT_DOUBLE_EQ(*options.speed, 3.0);
}

}  // namespace
}  // namespace suspension_health_monitor
