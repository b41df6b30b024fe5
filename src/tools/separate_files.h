#pragma once

#include <boost/program_options/variables_map.hpp>
#include <string>
#include <vector>

namespace suspension_health_monitor {

/// Refuses to write a file that is read, too, or to write two results into one file.
/// @param inputs, outputs  names of options with a path, or several, as their value; those not given do not matter.
/// @throws std::invalid_argument  naming option and path.
void requireSeparateFiles(const boost::program_options::variables_map& values, const std::vector<std::string>& inputs,
                          const std::vector<std::string>& outputs);

}  // namespace suspension_health_monitor
