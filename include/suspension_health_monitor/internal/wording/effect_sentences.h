#pragma once

#include <string>
#include <string_view>

namespace suspension_health_monitor {

/// What a workshop should make of an effect of the catalogue, in a sentence: whether it is design, wear or a fault of
/// the sensor, and what to check. What it is stands in the catalogue itself (ForceEffect::finding).
/// @return empty for a law that a user has written.
std::string adviceOn(std::string_view effect);

}  // namespace suspension_health_monitor
