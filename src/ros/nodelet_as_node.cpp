// Runs one nodelet as a node of its own, until ROS shuts down. The build says what the node is called, NODE, and which
// nodelet it is, NODELET.
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

namespace {

/// What the node does, which `suspension_bag options` it has, and a launch file with it.
const std::map<std::string, std::array<const char*, 3>> kNodes{
    {"monitor",
     {"Watches a strut through the IMU above and the IMU below it.", "monitor",
      "monitor.launch sprung_imu:=/body/imu unsprung_imu:=/front_left/imu"}},
    {"vehicle",
     {"Watches all struts of a vehicle, whose file is the parameter ~vehicle.", "monitor",
      "vehicle.launch vehicle:=/path/to/my_vehicle.yaml"}},
    {"simulator",
     {"Publishes the IMUs of a simulated strut, or of a vehicle (`suspension_bag options vehicle`).", "simulator",
      "simulation.launch scenario:=iso_road vehicle:=ugv rate:=100"}}};

std::string usage() {
  const auto& [summary, options, launch] = kNodes.at(NODE);
  return std::string("usage: " NODE "_node [TOPIC:=OTHER | __name:=NAME | _SETTING:=VALUE]...\n\n") + summary +
         "\nSettings are private parameters: `rosrun suspension_health_monitor suspension_bag options " + options +
         "`.\nFor example:\n  roslaunch suspension_health_monitor " + launch + "\n";
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int kWrongUsage = 2;
  ros::V_string arguments;
  ros::removeROSArgs(argc, argv, arguments);
  if (arguments.size() > 1) {
    const bool is_asked = arguments[1] == "--help" || arguments[1] == "-h";
    if (!is_asked) std::cerr << NODE "_node: unknown argument " << arguments[1] << "\n";
    (is_asked ? std::cout : std::cerr) << usage();
    return is_asked ? EXIT_SUCCESS : kWrongUsage;
  }
  ros::init(argc, argv, NODE);
  nodelet::Loader loader;
  if (!loader.load(ros::this_node::getName(), NODELET, ros::names::getRemappings(), {}))
    return EXIT_FAILURE;  // it has logged why it refused to start
  ros::spin();
  return EXIT_SUCCESS;
}
