// Reads and deserialises the Imu messages of a bag with rosbag's own view: the yardstick for `suspension_bag identify`.
//   read_with_view BAG
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>

#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  rosbag::Bag bag(argv[1]);
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/sprung/imu", "/unsprung/imu"}));
  double sum = 0.0;
  for (const rosbag::MessageInstance& message : view)
    sum += message.instantiate<sensor_msgs::Imu>()->linear_acceleration.z;
  std::printf("%u messages, mean %g\n", view.size(), sum / view.size());
}
