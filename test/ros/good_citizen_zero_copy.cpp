// Zero copy needs shared pointers: a monitor in this very process gets the publisher's own messages, and its estimates
// come without a connection.
#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <suspension_health_monitor/ParameterEstimate.h>

#include <atomic>
#include <cmath>
#include <thread>

namespace suspension_health_monitor {
namespace {

constexpr int kMessages = 500;

/// Publishes one reading and lets go of it. Were it serialised, nobody else would hold it, and it would end right here.
void publish(const ros::Publisher& publisher, int index, double acceleration, std::atomic<int>& ended_elsewhere) {
  const std::thread::id here = std::this_thread::get_id();
  sensor_msgs::ImuPtr imu(new sensor_msgs::Imu, [here, &ended_elsewhere](sensor_msgs::Imu* message) {
    if (std::this_thread::get_id() != here) ++ended_elsewhere;
    delete message;
  });
  imu->header.stamp = ros::Time(1000.0 + 0.02 * index);
  imu->linear_acceleration.z = acceleration;
  publisher.publish(imu);
}

TEST(GoodCitizen, ZeroCopyNeedsSharedPointers) {
  ros::NodeHandle node;
  nodelet::Loader loader(false);
  ros::param::set("/monitor/sample_period", 0.02);
  ASSERT_TRUE(loader.load("/monitor", "suspension_health_monitor/MonitorNodelet", {}, {}));
  std::array<ros::Publisher, 2> imu{node.advertise<sensor_msgs::Imu>("sprung/imu", kMessages),
                                    node.advertise<sensor_msgs::Imu>("unsprung/imu", kMessages)};
  std::atomic<int> estimates{0};
  const ros::Subscriber la = node.subscribe<ParameterEstimate>("/monitor/la", kMessages,
                                                               [&](const ParameterEstimateConstPtr&) { ++estimates; });
  ros::AsyncSpinner spinner(1);
  spinner.start();
  const auto wait = [](const auto& done) {
    for (int i = 0; i < 30000 && !done(); ++i) ros::WallDuration(0.01).sleep();
    return done();
  };
  ASSERT_TRUE(wait([&] { return imu[0].getNumSubscribers() + imu[1].getNumSubscribers() == 2; }));
  ASSERT_TRUE(wait([&] { return la.getNumPublishers() == 1; }));

  std::atomic<int> ended_elsewhere{0};
  for (int k = 0; k < kMessages; ++k) {
    publish(imu[0], k, std::sin(0.3 * k), ended_elsewhere);
    publish(imu[1], k, std::cos(0.4 * k), ended_elsewhere);
  }
  EXPECT_TRUE(wait([&] { return estimates == kMessages; })) << estimates;
  EXPECT_GT(ended_elsewhere, kMessages);  // nearly all of 2 kMessages
  loader.clear();
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "good_citizen_zero_copy");
  return RUN_ALL_TESTS();
}
