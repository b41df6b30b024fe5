#pragma once

#include <nodelet/loader.h>
#include <ros/ros.h>

#include <cstdlib>
#include <string>

namespace suspension_health_monitor {

/// Runs one nodelet as a node of its own, until ROS shuts down.
/// @return the exit status of main: failure if the nodelet refused to start (it has then logged why).
inline int runNodeletAsNode(int argc, char** argv, const std::string& node_name, const std::string& nodelet_type) {
  ros::init(argc, argv, node_name);
  nodelet::Loader loader;
  nodelet::V_string arguments(argv + 1, argv + argc);
  if (!loader.load(ros::this_node::getName(), nodelet_type, ros::names::getRemappings(), arguments))
    return EXIT_FAILURE;
  ros::spin();
  return EXIT_SUCCESS;
}

}  // namespace suspension_health_monitor
