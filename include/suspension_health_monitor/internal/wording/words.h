#pragma once

#include <string>
#include <vector>

namespace suspension_health_monitor {

/// @return the names one after the other with `separator` between them.
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

/// @return a share in percent, with one decimal below 1 %: "12 %".
std::string percent(double share);

}  // namespace suspension_health_monitor
