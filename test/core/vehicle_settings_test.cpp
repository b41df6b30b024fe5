#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/simulation/vehicle_simulator.h"

namespace suspension_health_monitor {
namespace {

Vehicle changed(OptionMap values, Vehicle vehicle = namedVehicle("sedan")) {
  changeVehicle(values, builtInEffects(), vehicle);
  EXPECT_TRUE(values.empty()) << values.begin()->first;
  return vehicle;
}

TEST(VehicleSettings, ChangeWhatTheyName) {
  const Vehicle vehicle = changed({{"mass", 1500.0},
                                   {"speed", 20.0},
                                   {"iso_class", "D"},
                                   {"struts/rear_left/damping", 1000.0},
                                   {"struts/rear_left/damping_end_fraction", 0.6},
                                   {"struts/rear_left/effects/bump_stop/coefficient", 40.0},
                                   {"struts/rear_left/effects/bump_stop/g", 0.02},
                                   {"anti_roll_bars/front_left/front_right", 9000.0},
                                   {"known_forces/tow_bar/x", -2.5},
                                   {"known_forces/tow_bar/rms", 700.0},
                                   {"body_imu/yaw", 0.3}});
  EXPECT_EQ(vehicle.mass, 1500.0);
  EXPECT_EQ(vehicle.speed, 20.0);
  EXPECT_EQ(vehicle.iso_class, "D");
  EXPECT_EQ(vehicle.struts[2].damping, 1000.0);
  EXPECT_EQ(vehicle.struts[2].damping_end_fraction, 0.6);
  ASSERT_EQ(vehicle.struts[2].hidden.size(), 1U);
  EXPECT_EQ(vehicle.struts[2].hidden[0].effect.name, "bump_stop");
  EXPECT_EQ(vehicle.struts[2].hidden[0].coefficient, 40.0);
  EXPECT_EQ(vehicle.struts[2].hidden[0].shapes, std::vector<double>{0.02});
  EXPECT_TRUE(vehicle.struts[0].hidden.empty());
  ASSERT_EQ(vehicle.anti_roll_bars.size(), 1U);
  EXPECT_EQ(vehicle.anti_roll_bars[0].first, 0U);
  EXPECT_EQ(vehicle.anti_roll_bars[0].second, 1U);
  EXPECT_EQ(vehicle.anti_roll_bars[0].stiffness, 9000.0);
  ASSERT_EQ(vehicle.known_forces.size(), 1U);
  EXPECT_EQ(vehicle.known_forces[0].x, -2.5);
  EXPECT_EQ(vehicle.body_imu.yaw, 0.3);
}

TEST(VehicleSettings, ChangeWhatIsThereInsteadOfAddingToIt) {
  const Vehicle once = changed({{"struts/rear_left/effects/quadratic_damping/coefficient", 1.0},
                                {"anti_roll_bars/front_left/front_right", 9000.0},
                                {"known_forces/tow_bar/rms", 700.0}});
  const Vehicle twice = changed({{"struts/rear_left/effects/quadratic_damping/coefficient", 2.0},
                                 {"anti_roll_bars/front_right/front_left", 8000.0},
                                 {"known_forces/tow_bar/x", 1.0}},
                                once);
  ASSERT_EQ(twice.struts[2].hidden.size(), 1U);
  EXPECT_EQ(twice.struts[2].hidden[0].coefficient, 2.0);
  ASSERT_EQ(twice.anti_roll_bars.size(), 1U);
  EXPECT_EQ(twice.anti_roll_bars[0].stiffness, 8000.0);
  ASSERT_EQ(twice.known_forces.size(), 1U);
  EXPECT_EQ(twice.known_forces[0].rms, 700.0);
}

OptionMap tricycle() {
  OptionMap values{{"mass", 100.0}, {"pitch_inertia", 20.0}, {"roll_inertia", 10.0}, {"speed", 3.0}};
  const auto add = [&](const std::string& name, double x, double y) {
    const std::string group = "struts/" + name + '/';
    values[group + "x"] = x;
    values[group + "y"] = y;
    values[group + "damping"] = 150.0;
    values[group + "stiffness"] = 5000.0;
    values[group + "wheel_mass"] = 3.0;
    values[group + "tyre_stiffness"] = 30000.0;
  };
  add("front", 0.8, 0.0);
  add("left", -0.4, 0.5);
  add("right", -0.4, -0.5);
  return values;
}

TEST(VehicleSettings, MakeAVehicleOfAnyNumberOfStruts) {
  OptionMap values = tricycle();
  const Vehicle vehicle = takeVehicle(values, builtInEffects());
  EXPECT_TRUE(values.empty());
  ASSERT_EQ(vehicle.struts.size(), 3U);
  EXPECT_EQ(vehicle.struts[vehicle.strutNamed("left")].y, 0.5);
  EXPECT_NEAR(vehicle.mobility(vehicle.struts[1], vehicle.struts[2]), 0.01 + 0.4 * 0.4 / 20.0 - 0.5 * 0.5 / 10.0,
              1e-12);
}

TEST(VehicleSettings, WrongOnesAreRefusedByName) {
  const auto complaint = [](const OptionMap& more, bool anew = false) -> std::string {
    try {
      OptionMap values = anew ? tricycle() : OptionMap{};
      for (const auto& [name, value] : more) values[name] = value;
      for (auto value = values.begin(); value != values.end();)
        value = value->second == OptionValue("left out") ? values.erase(value) : std::next(value);
      if (anew)
        takeVehicle(values, builtInEffects());
      else
        changed(values);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const auto expectWords = [](const std::string& message, std::initializer_list<const char*> all) {
    for (const char* words : all) EXPECT_NE(message.find(words), std::string::npos) << words << ", got: " << message;
  };
  expectWords(complaint({{"struts/rear_lft/damping", 1.0}}), {"rear_lft", "front_left, front_right, rear_left"});
  expectWords(complaint({{"struts/rear_left/dampin", 1.0}}), {"struts/rear_left: ", "dampin", "name is damping"});
  expectWords(complaint({{"struts/rear_left/damping", "soft"}}), {"struts/rear_left: damping", "soft"});
  expectWords(complaint({{"struts/rear_left/effects/bump_stop/coefficient", 1.0}}),
              {"struts/rear_left: effects/bump_stop/g is missing"});
  expectWords(complaint({{"struts/rear_left/effects/bumb_stop/coefficient", 1.0}}),
              {"struts/rear_left: ", "bumb_stop", "quadratic_damping"});
  expectWords(complaint({{"anti_roll_bars/front_left/front", 1.0}}), {"anti_roll_bars", "front_right"});
  expectWords(complaint({{"anti_roll_bars/front_left/front_right", "x"}}), {"anti_roll_bars/front_left/front_right"});
  expectWords(complaint({{"known_forces/tow bar/rms", 1.0}}), {"known_forces/tow bar", "letters"});
  expectWords(complaint({{"known_forces/tow_bar/rmss", 1.0}}), {"known_forces/tow_bar: ", "rmss"});
  expectWords(complaint({{"body_imu/yaww", 1.0}}), {"body_imu: ", "yaww"});
  expectWords(complaint({{"struts/left/wheel_mass", "left out"}}, true), {"struts/left: wheel_mass is missing"});
  expectWords(complaint({{"mass", "left out"}}, true), {"mass is missing"});
  expectWords(complaint({{"roll_inertia", "left out"}}, true), {"roll_inertia = 0", "above 0"});
  expectWords(complaint({{"struts/a b/x", 1.0}}, true), {"struts/a b", "letters"});
}

}  // namespace
}  // namespace suspension_health_monitor
