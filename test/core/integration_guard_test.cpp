#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "simulated_drive.h"
#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {
namespace {

SimulationOptions hiding(const std::string& name, double coefficient, const std::vector<double>& shapes) {
  SimulationOptions options = scenario("iso_road", 30.0);
  options.vehicle = "ugv";
  options.rate = 100.0;
  options.hidden = {{findEffect(forceEffects(), name), coefficient, shapes}};
  return options;
}

/// @return the complaint that ends the drive; empty: it came to its end, all finite.
std::string complaint(const SimulationOptions& options) {
  DriveSimulator simulator(options);
  try {
    while (const auto sample = simulator.next()) {
      EXPECT_TRUE(std::isfinite(sample->truth.sprung_acceleration));
      EXPECT_TRUE(std::isfinite(sample->sprung->acceleration) && std::isfinite(sample->unsprung->acceleration));
    }
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(VehicleMotion, EndsADriveThatRunsAway) {
  EXPECT_EQ(complaint(hiding("quadratic_damping", 5.0, {})), "");
  for (const auto& [name, coefficient] :
       {std::pair("quadratic_damping", -50.0), std::pair("asymmetric_damping", -400.0),
        std::pair("position_dependent_damping", -1e6)}) {
    const std::string words = complaint(hiding(name, coefficient, {}));
    EXPECT_NE(words.find("unstable"), std::string::npos) << name << words;
    EXPECT_NE(words.find(name), std::string::npos) << words;
  }
}

TEST(VehicleMotion, EndsADriveThatWouldNotEnd) {
  EXPECT_EQ(complaint(hiding("coulomb_friction", 1.0, {1e-4})), "");
  EXPECT_EQ(complaint(hiding("hysteresis", 1.0, {1e-4})), "");
  for (const char* name : {"coulomb_friction", "hysteresis"}) {
    const std::string words = complaint(hiding(name, 1.0, {1e-9}));
    EXPECT_NE(words.find("too stiff"), std::string::npos) << name << words;
    EXPECT_NE(words.find(std::string(name) + " = 1, "), std::string::npos) << words;
    EXPECT_NE(words.find(" = 1e-09"), std::string::npos) << words;
  }
}

TEST(VehicleMotion, NamesEveryHiddenEffect) {
  SimulationOptions options = hiding("bump_stop", 20.0, {0.01});
  options.hidden.push_back({findEffect(forceEffects(), "asymmetric_damping"), -400.0, {}});
  const std::string words = complaint(options);
  EXPECT_NE(words.find("bump_stop = 20, g = 0.01; asymmetric_damping = -400 is unstable"), std::string::npos) << words;
}

// The stiffest strut that the settings allow has steps of its own and is no case for the guard.
TEST(VehicleMotion, LetsAStiffStrutAndFastSensorsPass) {
  SimulationOptions stiff = scenario("iso_road", 0.05);
  stiff.vehicle = "ugv";
  stiff.stiffness_to_mass = 1e8;
  EXPECT_EQ(complaint(stiff), "");
  SimulationOptions fast = scenario("paper_clean", 20.0);
  fast.stiffness_to_mass = 1e-3;
  fast.rate = 20000.0;
  EXPECT_EQ(complaint(fast), "");
}

}  // namespace
}  // namespace suspension_health_monitor
