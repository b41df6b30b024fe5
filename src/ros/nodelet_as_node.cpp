// Runs one nodelet as a node of its own, until ROS shuts down. The build says what the node is called, NODE, and which
// nodelet it is, NODELET.
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <cstdlib>

int main(int argc, char** argv) {
  ros::init(argc, argv, NODE);
  nodelet::Loader loader;
  const nodelet::V_string arguments(argv + 1, argv + argc);
  if (!loader.load(ros::this_node::getName(), NODELET, ros::names::getRemappings(), arguments))
    return EXIT_FAILURE;  // it has logged why it refused to start
  ros::spin();
  return EXIT_SUCCESS;
}
