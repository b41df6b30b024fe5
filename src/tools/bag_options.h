#pragma once

#include <boost/program_options.hpp>

#include <string>

#include "../ros/shell_options.h"
#include "imu_bags.h"

namespace suspension_health_monitor {

/// What every subcommand that reads bags understands.
struct BagOptions {
  ImuBags bags;
  PipelineOptions pipeline;  ///< sample_period and the horizon are always set: configured, or measured from the bags
  bool period_measured = false;
  bool horizon_measured = false;
};

/// Adds the common options to a subcommand's own.
void addBagOptions(boost::program_options::options_description& description);

/// Collects the common options; reads the beginning of the bags for what the settings leave open.
/// @throws std::invalid_argument, InputError, TooLittleError  as command.h.
BagOptions readBagOptions(const boost::program_options::variables_map& values);

}  // namespace suspension_health_monitor
