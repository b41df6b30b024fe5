#pragma once

#include <ros/node_handle.h>

#include "suspension_health_monitor/option_table.h"

namespace suspension_health_monitor {

/// @param private_node  the node's or nodelet's private namespace.
/// @return all parameters below it, names joined with '/'.
/// @throws std::invalid_argument  on a value that no option can have (a list, a date, binary), naming it.
OptionMap readParameters(const ros::NodeHandle& private_node);

}  // namespace suspension_health_monitor
