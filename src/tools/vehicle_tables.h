#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_inertia.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// @throws TooLittleError  saying why, if the drives do not tell how the struts move one another.
void requireCoupling(const VehicleCoupling& coupling);

/// How the struts move one another, for people.
void printCoupling(const VehicleCoupling& coupling, const std::vector<std::string>& names);

/// The same for programs, with `struts` to be filled.
nlohmann::json toJson(const VehicleCoupling& coupling, const std::vector<std::string>& names);

/// How the body's mass is spread, for people and for programs.
void printBody(const BodyInertiaResult& found);
nlohmann::json toJson(const BodyInertiaResult& found);

}  // namespace suspension_health_monitor
