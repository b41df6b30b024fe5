#pragma once

#include <ros/node_handle.h>

#include <functional>

#include "suspension_health_monitor/internal/base/option_table.h"

namespace suspension_health_monitor {

/// @param private_node  the node's or nodelet's private namespace.
/// @return all parameters below it, names joined with '/', lists of texts with ", ".
/// @throws std::invalid_argument  on a value that no option can have (a list of numbers, a date, binary), naming it.
OptionMap readParameters(const ros::NodeHandle& private_node);

/// Runs the part of a nodelet's onInit that may refuse parameters. The nodelet loader drops a nodelet that throws
/// without a word, so what was thrown is logged here, with the namespace, and passed on.
void startOrRefuse(const ros::NodeHandle& private_node, const std::function<void()>& start);

}  // namespace suspension_health_monitor
