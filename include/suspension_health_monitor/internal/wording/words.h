#pragma once

#include <string>
#include <vector>

namespace suspension_health_monitor {

/// @return the names that are not empty one after the other with `separator` between them.
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

/// @return the text that std::printf would write.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// @return the size of a change in whole percent, whatever its sign: "12 %".
std::string sizeInPercent(double change);

/// @return a share in percent, with one decimal below 1 %: "12 %".
std::string percent(double share);

/// @param seconds  of driving that give enough samples, whatever else may be wrong with them.
/// @return to be read after what is too short.
std::string describeEnough(double seconds);

}  // namespace suspension_health_monitor
