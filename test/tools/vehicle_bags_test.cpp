// A vehicle file, and bags of its IMUs, as drives of all struts.
#include <geometry_msgs/WrenchStamped.h>
#include <gtest/gtest.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/vehicle_options.h"
#include "suspension_health_monitor/internal/signal/filters.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "tools/command.h"
#include "tools/recorded_drives.h"

namespace suspension_health_monitor {
namespace {

constexpr double kRate = 100.0, kGravity = 9.81;
constexpr double kTimeout = 2.0;                          // [s]
constexpr double kPitch = 0.2, kTurn = 2.0 * M_PI * 2.0;  // largest angular rate [rad/s], and its frequency [rad/s]

class VehicleBags : public testing::Test {
 protected:
  VehicleBags()
      : folder_(testing::TempDir() + "vehicle_bags_" + testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::create_directories(folder_);
  }
  ~VehicleBags() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + '/' + name) << text;
    return folder_ + '/' + name;
  }
  std::string path(const std::string& name) const { return folder_ + '/' + name; }

  std::string refusal(const std::string& text) const {
    try {
      readVehicleFile(write("wrong.yaml", text));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  std::string folder_;
};

void expectNamed(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

const char* const kVehicle =
    "body_imu: /imu/data\n"
    "struts:\n"
    "  front: {sprung_imu: /imu/front, unsprung_imu: /wheel/front}\n"
    "  middle: {unsprung_imu: /wheel/middle, position: [0.5, -0.3, 0.1]}\n"
    "  rear: {unsprung_imu: /wheel/rear, frame: rear_strut}\n";

double wheel(int strut, double t) { return kGravity + (2.0 + strut) * std::sin(2.0 * M_PI * 5.0 * t + strut); }

double pull(double t) { return 300.0 * std::cos(2.0 * M_PI * 1.5 * t); }  // [N]

sensor_msgs::Imu message(double t, double z) {
  sensor_msgs::Imu imu;
  imu.header.stamp = ros::Time(1000.0 + t);
  imu.header.frame_id = "imu_link";
  imu.linear_acceleration.z = z;
  return imu;
}

/// A body that pitches about its IMU. @param upside_down  the IMU's z and y axes point down and to the right.
void writeDrive(const std::string& path, double seconds, bool with_frame, bool upside_down = false) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  if (with_frame) {
    tf2_msgs::TFMessage tree;
    tree.transforms.resize(1);
    geometry_msgs::TransformStamped& transform = tree.transforms[0];
    transform.header.frame_id = "imu_link";
    transform.child_frame_id = "rear_strut";
    transform.transform.translation.x = -0.8;
    transform.transform.translation.y = upside_down ? -0.2 : 0.2;
    transform.transform.rotation.z = std::sqrt(0.5);  // how the strut's frame is turned does not count
    transform.transform.rotation.w = std::sqrt(0.5);
    bag.write("/tf_static", ros::Time(1000.0), tree);
  }
  const double down = upside_down ? -1.0 : 1.0;
  for (int k = 0; k < seconds * kRate; ++k) {
    const double t = k / kRate;
    sensor_msgs::Imu body = message(t, down * kGravity);
    body.angular_velocity.y = down * kPitch * std::sin(kTurn * t);
    bag.write("/imu/data", body.header.stamp, body);
    const double alpha = kPitch * kTurn * std::cos(kTurn * t);
    bag.write("/imu/front", body.header.stamp, message(t, down * (kGravity - 1.2 * alpha)));
    bag.write("/wheel/front", body.header.stamp, message(t, wheel(0, t)));
    bag.write("/wheel/middle", body.header.stamp, message(t + 2e-4, wheel(1, t)));
    bag.write("/wheel/rear", body.header.stamp, message(t, wheel(2, t)));
    geometry_msgs::WrenchStamped wrench;
    wrench.header.stamp = body.header.stamp;
    wrench.wrench.force.z = pull(t);
    wrench.wrench.force.x = 50.0;
    wrench.wrench.torque.y = -2.0 * pull(t);
    bag.write("/tow_bar", body.header.stamp, wrench);
  }
}

/// @param options  whose topics, positions and sample period are found.
RecordedDrives read(BagOptions& options, TopicGaps& gaps) {
  findSensors(options.bags, options.settings.common.shell, options.vehicle.layout);
  options.settings.common.monitor.sample_period = measurePeriod(options.bags);
  return readDrives(options, gaps);
}

TEST_F(VehicleBags, AreReadAsDrivesOfAllStrutsWithOneGrid) {
  const VehicleLayout layout = readVehicleFile(write("vehicle.yaml", kVehicle));
  for (const bool upside_down : {false, true}) {
    writeDrive(path("one.bag"), 10.0, true, upside_down);
    writeDrive(path("two.bag"), 5.0, true, upside_down);
    BagOptions options;
    options.vehicle.layout = layout;
    options.bags.paths = {path("one.bag"), path("two.bag")};
    if (upside_down) options.settings.common.shell.sprung_axis = "-z";
    TopicGaps gaps(kTimeout);
    const auto [drives, bags] = read(options, gaps);
    EXPECT_TRUE(gaps.toJson().empty());
    for (const VehicleLayout::Strut& strut : options.vehicle.layout.struts)
      EXPECT_TRUE(strut.position || !strut.frame) << strut.name;
    EXPECT_NEAR(options.period(), 1.0 / kRate, 1e-6);
    ASSERT_EQ(drives.size(), 2u);
    EXPECT_EQ(describeAlignment(bags[0].grid.streams()), "paired");
    ASSERT_EQ(drives[0].struts.size(), 3u);
    ASSERT_EQ(drives[1].struts[0].samples.size(),
              500u - 2 * static_cast<std::size_t>(MotionFilter(std::chrono::milliseconds(10), 1, 1).delay()));
    for (std::size_t k = 0; k < drives[0].struts[0].samples.size(); ++k) {
      const double t = toSeconds(drives[0].struts[0].samples[k].stamp) - 1000.0;
      const double alpha = kPitch * kTurn * std::cos(kTurn * t), rate = kPitch * std::sin(kTurn * t);
      const std::vector<double> tops{kGravity - 1.2 * alpha, kGravity - 0.5 * alpha - 0.1 * rate * rate,
                                     kGravity + 0.8 * alpha};
      for (int i = 0; i < 3; ++i) {
        const CornerSample& sample = drives[0].struts[static_cast<std::size_t>(i)].samples[k];
        ASSERT_EQ(sample.stamp, drives[0].struts[0].samples[k].stamp);
        ASSERT_NEAR(sample.sprung_acceleration, tops[static_cast<std::size_t>(i)], 3e-3) << i << " at " << t;
        ASSERT_NEAR(sample.unsprung_acceleration, wheel(i, t), 5e-3) << i << " at " << t;
      }
    }
    const VehicleGrid& grid = bags[0].grid;
    const std::vector<RejectCounts>& rejected = bags[0].rejected;
    ASSERT_EQ(rejected.size(), 5u);
    for (std::size_t i = 0; i < rejected.size(); ++i)
      EXPECT_EQ(rejected[i].total() + grid.missed(i), 0u) << options.bags.topics[i].name;
  }
}

// As late as everything else, by the filter of the one body IMU, and counted if they are no numbers.
TEST_F(VehicleBags, HoldKnownForcesOnTheSameGrid) {
  writeDrive(path("drive.bag"), 5.0, true);
  {
    rosbag::Bag bag(path("drive.bag"), rosbag::bagmode::Append);
    geometry_msgs::WrenchStamped wrong;
    wrong.header.stamp = ros::Time(1010.0);
    wrong.wrench.force.z = std::nan("");
    bag.write("/tow_bar", wrong.header.stamp, wrong);
  }
  const std::string forces =
      "known_forces:\n  lift: {topic: /tow_bar, field: force.z}\n  turn: {topic: /tow_bar, field: torque.y}\n";
  BagOptions options;
  options.vehicle.layout = readVehicleFile(write("vehicle.yaml", kVehicle + forces));
  options.bags.paths = {path("drive.bag")};
  TopicGaps gaps(kTimeout);
  const auto [drives, bags] = read(options, gaps);
  ASSERT_EQ(drives[0].forces.size(), 2u);
  EXPECT_EQ(drives[0].forces[0].name, "lift");
  EXPECT_EQ(drives[0].forces[1].name, "turn");
  const std::vector<CornerSample>& samples = drives[0].struts[0].samples;
  ASSERT_GT(samples.size(), 400u);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double t = toSeconds(samples[k].stamp) - 1000.0;
    ASSERT_NEAR(drives[0].forces[0].values[k], pull(t), 0.5) << t;
    ASSERT_NEAR(drives[0].forces[1].values[k], -2.0 * pull(t), 1.0) << t;
  }
  ASSERT_EQ(bags[0].rejected.size(), 6u);
  EXPECT_EQ(options.bags.topics[5].name, "/tow_bar");
  EXPECT_EQ(bags[0].rejected[5].count(RejectReason::kNotFinite), 1u);
}

TEST_F(VehicleBags, OfOtherVehiclesAreRefused) {
  writeDrive(path("drive.bag"), 1.0, false);
  const auto said = [&](const std::string& file) {
    BagOptions options;
    options.bags.paths = {path("drive.bag")};
    try {
      options.vehicle.layout = readVehicleFile(write("vehicle.yaml", file));
      TopicGaps gaps(kTimeout);
      read(options, gaps);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  expectNamed(said(kVehicle), {"drive.bag", "/tf_static", "frame of a strut"});
  expectNamed(said("struts: {only: {sprung_imu: /imu/front, unsprung_imu: /wheel/left}}"),
              {"no topic /wheel/left (struts/only/unsprung_imu)", "/wheel/front"});
  expectNamed(said("struts: {only: {sprung_imu: /imu/front, unsprung_imu: /wheel/front}}\n"
                   "known_forces: {bar: {topic: /bar, field: force.z}}"),
              {"no topic /bar (known_forces/bar/topic)", "WrenchStamped topics in this bag: /tow_bar"});
  EXPECT_EQ(said("struts: {only: {sprung_imu: /imu/front, unsprung_imu: /wheel/front}}"), "accepted");
  writeDrive(path("drive.bag"), 1.0, true);
  expectNamed(said("body_imu: /imu/data\nstruts: {only: {unsprung_imu: /wheel/front, frame: front_strut}}"),
              {"struts/only/frame = \"front_strut\"", "imu_link"});
  expectNamed(said("body_imu: /imu/data\n"
                   "struts:\n"
                   "  left: {unsprung_imu: /wheel/front, frame: rear_strut}\n"
                   "  right: {unsprung_imu: /wheel/rear, frame: rear_strut}\n"),
              {"struts/right/frame is where struts/left is"});
}

TEST_F(VehicleBags, NeedAVehicleFileWithoutMistakes) {
  expectNamed(refusal(""), {"wrong.yaml: struts are missing"});
  expectNamed(refusal("body_imu: /imu/data\nstruts: {}\n"), {"wrong.yaml", "struts", "{}"});
  const std::string good = "  a: {sprung_imu: /a, unsprung_imu: /b}\n";
  EXPECT_EQ(refusal("struts:\n" + good), "accepted");
  expectNamed(refusal("struts:\n" + good + "  a: {sprung_imu: /c}\n"),
              {"wrong.yaml: line 3", "struts/a", "given twice"});
  expectNamed(refusal("struts:\n" + good + "  b: {}\n"), {"wrong.yaml: struts/b must be struts/NAME/SETTING"});
  expectNamed(refusal("struts:\n" + good + "  b:\n"), {"wrong.yaml: line", "struts/b", "plain value"});
  expectNamed(refusal("struts:\n" + good + "  b: {unsprung_imu: /c}\n"),
              {"wrong.yaml: struts/b/sprung_imu", "body_imu"});
  expectNamed(refusal("struts:\n" + good + "  b: {sprung_imu: /c, unsprung_imu: /d, position: [.nan, 0, 0]}\n"),
              {"wrong.yaml: struts/b/position = [.nan, 0, 0]", "three numbers"});
  expectNamed(refusal("struts:\n" + good + "  front/left: {sprung_imu: /c, unsprung_imu: /d}\n"),
              {"wrong.yaml", "front"});
  expectNamed(refusal("struts: [a, b]\n"), {"wrong.yaml", "struts"});
  expectNamed(refusal("strut:\n" + good), {"wrong.yaml", "strut"});
  EXPECT_THROW(readVehicleFile(path("missing.yaml")), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
