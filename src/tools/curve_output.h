#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

inline constexpr double kNinetyPercent = 1.645;  ///< standard deviations

/// Reads bags as drives and fits curves, from the linear struts that identify found.
/// @param found  by strut.  @return likewise; empty curves where nothing was found, or is not asked for.
std::vector<StrutCurves> curvesOfBags(BagOptions options, const std::vector<IdentifyResult>& found);

/// Tells people the forces at even travel rates and travels, compression beside rebound, with nine tenths of certainty.
/// @param mass  of the body [kg], for forces in N; nothing: over the mass.
void printCurves(const StrutCurves& curves, const std::optional<double>& mass);

/// Adds "damper_curve" and "spring_curve", over the body's mass.
void addCurves(const StrutCurves& curves, nlohmann::json& into);

/// What the page of curves is made of.
/// @param whole  what was found, as --json has it.
/// @param source  as sourceOf().  @param origin  as originOf().
nlohmann::json curveFindings(const AskedVehicle& vehicle, nlohmann::json whole, const std::string& source,
                             const nlohmann::json& origin);

}  // namespace suspension_health_monitor
