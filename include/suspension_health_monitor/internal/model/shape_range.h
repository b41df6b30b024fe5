#pragma once

#include <string>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {

/// What a shape may be at all: a plain number what its law allows; one that is measured in what a drive shows, anything
/// from a billionth of its unit to a billion, as nobody has seen the drive yet.
/// @param name  as people know it, e.g. bump_stop/g.
/// @throws std::invalid_argument  with name, value, unit and the range.
void requireAllowed(const std::string& name, const ShapeParameter& shape, double value);

}  // namespace suspension_health_monitor
