#include "nodelet_as_node.h"

int main(int argc, char** argv) {
  return suspension_health_monitor::runNodeletAsNode(argc, argv, "vehicle", "suspension_health_monitor/VehicleNodelet");
}
