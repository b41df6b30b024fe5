#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace suspension_health_monitor {
namespace {

OptionValue text(const std::string& words) { return words; }

/// A body's IMU, a strut with its own, one at a position, one at a frame, and a force.
OptionMap mixedVehicle() {
  return {{"body_imu", text("/imu/data")},
          {"struts/front_left/sprung_imu", text("/imu/front_left")},
          {"struts/front_left/unsprung_imu", text("/wheel/front_left")},
          {"struts/rear_left/unsprung_imu", text("/wheel/rear_left")},
          {"struts/rear_left/position", UnusableList{"[-0.4, 0.3, 1e-1]"}},
          {"struts/rear_right/unsprung_imu", text("~rear_right")},
          {"struts/rear_right/frame", text("rear_right_strut")},
          {"known_forces/tow_bar/topic", text("/tow_bar/wrench")},
          {"known_forces/tow_bar/field", text("force.z")}};
}

std::string refusal(const OptionMap& changes, const std::vector<std::string>& without = {}) {
  OptionMap values = mixedVehicle();
  for (const std::string& name : without) values.erase(name);
  for (const auto& [name, value] : changes) values[name] = value;
  try {
    takeVehicle(values);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expectNamed(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(VehicleLayout, TakesWhatTheFileSays) {
  OptionMap values = mixedVehicle();
  const VehicleLayout layout = takeVehicle(values);
  EXPECT_TRUE(values.empty());
  EXPECT_EQ(layout.body_imu, "/imu/data");
  ASSERT_EQ(layout.struts.size(), 3u);
  EXPECT_EQ(layout.struts[0].name, "front_left");
  EXPECT_EQ(layout.struts[0].sprung_imu, "/imu/front_left");
  EXPECT_EQ(layout.struts[0].unsprung_imu, "/wheel/front_left");
  EXPECT_FALSE(layout.struts[0].position || layout.struts[0].frame);
  EXPECT_FALSE(layout.struts[1].sprung_imu);
  EXPECT_EQ(layout.struts[1].position, (std::array{-0.4, 0.3, 0.1}));
  EXPECT_EQ(layout.struts[2].frame, "rear_right_strut");
  ASSERT_EQ(layout.known_forces.size(), 1u);
  EXPECT_EQ(layout.known_forces[0].name, "tow_bar");
  EXPECT_EQ(layout.known_forces[0].topic, "/tow_bar/wrench");
  EXPECT_EQ(kWrenchFields[layout.known_forces[0].field], "force.z");
}

TEST(VehicleLayout, NeedsNoBodyImuWhereEveryStrutHasItsOwn) {
  OptionMap values{{"struts/only/sprung_imu", text("a")}, {"struts/only/unsprung_imu", text("b")}};
  const VehicleLayout layout = takeVehicle(values);
  EXPECT_FALSE(layout.body_imu);
  EXPECT_EQ(layout.struts.size(), 1u);
  EXPECT_TRUE(layout.known_forces.empty());
}

TEST(VehicleLayout, RefusesWhatIsMissing) {
  OptionMap none{{"body_imu", text("/imu/data")}};
  EXPECT_THROW(takeVehicle(none), std::invalid_argument);
  expectNamed(refusal({}, {"struts/front_left/unsprung_imu"}), {"struts/front_left/unsprung_imu", "missing"});
  expectNamed(refusal({}, {"body_imu"}), {"struts/rear_left/sprung_imu", "missing", "body_imu"});
  expectNamed(refusal({}, {"struts/rear_left/position"}), {"struts/rear_left", "position: [x, y, z]", "frame"});
  expectNamed(refusal({}, {"known_forces/tow_bar/field"}), {"known_forces/tow_bar/field", "missing", "topic, field"});
  expectNamed(refusal({}, {"known_forces/tow_bar/topic"}), {"known_forces/tow_bar/topic", "missing"});
}

TEST(VehicleLayout, RefusesUnknownNamesAndProposesTheNearest) {
  expectNamed(refusal({{"body_imus", text("/a")}}), {"body_imus", "nearest", "body_imu"});
  expectNamed(refusal({{"strut/a/unsprung_imu", text("/a")}}), {"strut/a/unsprung_imu", "/a"});
  expectNamed(refusal({{"struts/front_left/unsprung_imo", text("/a")}}),
              {"struts/front_left", "unsprung_imo", "/a", "nearest", "unsprung_imu"});
  expectNamed(refusal({{"struts/rear_left/positon", text("/a")}}),
              {"struts/rear_left", "positon", "nearest", "position"});
  expectNamed(refusal({{"known_forces/tow_bar/topics", text("/a")}}), {"known_forces/tow_bar", "topics", "nearest"});
  expectNamed(refusal({{"struts", text("front_left")}}), {"struts", "front_left"});
  expectNamed(refusal({{"struts/front_left", UnusableList{"{}"}}}), {"struts/front_left", "struts/NAME/SETTING"});
}

TEST(VehicleLayout, RefusesPositionsThatAreNone) {
  const auto with = [](const OptionValue& value) { return refusal({{"struts/rear_left/position", value}}); };
  for (const char* list : {"[.nan, 0, 0]", "[0, nan, 0]", "[0, 0, inf]", "[1, 2]", "[1, 2, 3, 4]", "[1, 2, x]",
                           "[[...], 1, 2]", "[1, 2, 300]", "[]", "{}"})
    expectNamed(with(UnusableList{list}), {"struts/rear_left/position = ", list, "[x, y, z]", "[-100, 100] [m]"});
  expectNamed(with(text("nan, nan, nan")), {"struts/rear_left/position = [nan, nan, nan]", "[-100, 100] [m]"});
  expectNamed(with(0.3), {"struts/rear_left/position", "three numbers"});
  expectNamed(refusal({{"struts/rear_left/frame", text("rear")}}), {"struts/rear_left", "a position and a frame"});
}

TEST(VehicleLayout, RefusesNamesAndTopicsThatRosWould) {
  for (const char* name : {"1st", "front-left", "front left", "_front", "vörn"})
    expectNamed(refusal({{std::string("struts/") + name + "/unsprung_imu", text("/a")}}),
                {name, "letters, digits and _, a letter first"});
  expectNamed(refusal({{"struts/" + std::string(65, 'a') + "/unsprung_imu", text("/a")}}), {"at most 64 characters"});
  expectNamed(refusal({{"known_forces/tow-bar/topic", text("/a")}}), {"tow-bar", "a letter first"});
  for (const char* topic : {"/imu data", "imu/data?", "7th", "-"}) {
    expectNamed(refusal({{"body_imu", text(topic)}}), {"body_imu", topic, "must be a topic"});
    expectNamed(refusal({{"struts/front_left/sprung_imu", text(topic)}}),
                {"struts/front_left/sprung_imu", topic, "must be a topic"});
    expectNamed(refusal({{"known_forces/tow_bar/topic", text(topic)}}), {"known_forces/tow_bar/topic", topic});
  }
  for (const char* field : {"force..z", "force", "z", "force.w", "wrench.force.z", "Force.z"})
    expectNamed(refusal({{"known_forces/tow_bar/field", text(field)}}),
                {"known_forces/tow_bar/field", field,
                 "must be one of force.x, force.y, force.z, torque.x, torque.y, torque.z"});
  expectNamed(refusal({{"struts/rear_right/frame", text("a b")}}), {"struts/rear_right/frame", "a b"});
}

TEST(VehicleLayout, RefusesOneImuInTwoPlaces) {
  expectNamed(refusal({{"struts/rear_left/unsprung_imu", text("/wheel/front_left")}}),
              {"struts/rear_left/unsprung_imu", "/wheel/front_left", "struts/front_left/unsprung_imu", "position"});
  expectNamed(refusal({{"struts/front_left/sprung_imu", text("/imu/data")}}),
              {"struts/front_left/sprung_imu", "/imu/data", "body_imu"});
}

TEST(VehicleLayout, RefusesAForceTwiceAndOneOnTheTopicOfAnImu) {
  const auto second = [](const char* topic, const char* field) {
    return refusal({{"known_forces/winch/topic", text(topic)}, {"known_forces/winch/field", text(field)}});
  };
  EXPECT_EQ(second("/tow_bar/wrench", "force.x"), "accepted");
  expectNamed(second("/tow_bar/wrench", "force.z"), {"known_forces/winch", "known_forces/tow_bar", "another force"});
  expectNamed(second("/imu/data", "force.z"), {"known_forces/winch/topic", "/imu/data", "body_imu"});
}

TEST(VehicleLayout, RefusesMoreStrutsThanAVehicleHas) {
  OptionMap values;
  for (char letter = 'a'; letter < 'a' + 17; ++letter)
    for (const char* side : {"sprung_imu", "unsprung_imu"})
      values[std::string("struts/") + letter + '/' + side] = std::string("/") + side + '/' + letter;
  OptionMap sixteen = values;
  sixteen.erase("struts/q/sprung_imu");
  sixteen.erase("struts/q/unsprung_imu");
  EXPECT_EQ(takeVehicle(sixteen).struts.size(), 16u);
  try {
    takeVehicle(values);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    expectNamed(error.what(), {"struts: 17", "at most 16"});
  }
  OptionMap forces;
  for (const char* name : {"a", "b", "c", "d"})
    for (const char* setting : {"topic", "field"})
      forces[std::string("known_forces/") + name + '/' + setting] =
          std::string(setting) == "topic" ? std::string(name) : std::string("force.z");
  expectNamed(refusal(forces), {"known_forces: 5", "at most 4"});
}

TEST(VehicleStreams, NumberWhatTheStrutsNeed) {
  OptionMap values = mixedVehicle();
  VehicleLayout layout = takeVehicle(values);
  layout.struts[2].position = {-0.4, -0.3, 0.1};
  const VehicleStreams streams(layout);
  EXPECT_EQ(streams.options.size(), 6u + 2u + 1u + 1u + 1u);
  std::vector<std::size_t> sensors;
  for (const StreamOptions& each : streams.options) sensors.push_back(each.sensor);
  EXPECT_EQ(sensors, (std::vector<std::size_t>{0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(streams.channels.body_imu, 0u);
  EXPECT_EQ(streams.channels.struts[0].sprung, 6u);
  EXPECT_EQ(streams.channels.struts[0].unsprung, 7u);
  EXPECT_FALSE(streams.channels.struts[1].sprung);
  EXPECT_EQ(streams.channels.struts[1].unsprung, 8u);
  EXPECT_EQ(streams.channels.struts[2].position, Eigen::Vector3d(-0.4, -0.3, 0.1));
  EXPECT_EQ(streams.channels.known_forces, std::vector<std::size_t>{10});
  for (std::size_t i = 0; i < streams.options.size(); ++i) EXPECT_EQ(streams.options[i].is_force, i == 10) << i;
  ASSERT_EQ(streams.sensors.size(), 6u);
  EXPECT_EQ(streams.sensors[1].topic, "/imu/front_left");
  EXPECT_EQ(streams.sensors[4].setting, "struts/rear_right/unsprung_imu");
  EXPECT_EQ(streams.sensors[4].stream, 9u);
  EXPECT_EQ(streams.sensors[5].setting, "known_forces/tow_bar/topic");
  EXPECT_EQ(streams.sensors[5].topic, "/tow_bar/wrench");
  for (std::size_t i = 0; i < streams.sensors.size(); ++i)
    EXPECT_EQ(streams.sensors[i].place == VehicleStreams::Place::kForce, i == 5) << i;
}

TEST(VehicleStreams, OfForcesFromOneTopicAreOfOneSensor) {
  VehicleLayout layout;
  layout.struts = {{"only", "/wheel", "/imu/top", {}, {}}};
  layout.known_forces = {{"lift", "/tow_bar", 2}, {"winch", "/winch", 0}, {"pull", "/tow_bar", 0}};
  const VehicleStreams streams(layout);
  ASSERT_EQ(streams.sensors.size(), 4u);
  EXPECT_EQ(streams.sensors[2].topic, "/tow_bar");
  EXPECT_EQ(streams.sensors[2].fields, (std::vector<std::size_t>{2, 0}));
  EXPECT_EQ(streams.sensors[3].fields, std::vector<std::size_t>{0});
  EXPECT_EQ(streams.channels.known_forces, (std::vector<std::size_t>{2, 4, 3}));
  EXPECT_EQ(streams.options[3].sensor, 2u);
  EXPECT_EQ(streams.options[4].sensor, 3u);
}

TEST(VehicleStreams, LeaveABodyImuOutThatNoStrutNeedsAndRefuseAStrutNobodyPlaces) {
  VehicleLayout layout;
  layout.body_imu = "/imu/data";
  layout.struts = {{"only", "/wheel", "/imu/top", {}, {}}};
  EXPECT_EQ(VehicleStreams(layout).options.size(), 2u);
  layout.struts[0].sprung_imu.reset();
  EXPECT_THROW(VehicleStreams{layout}, std::invalid_argument);  // its frame was never looked up
  layout.struts[0].position = {0.0, 0.0, 0.0};
  EXPECT_EQ(VehicleStreams(layout).options.size(), 7u);
}

}  // namespace
}  // namespace suspension_health_monitor
