#pragma once

#include <optional>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/compare/travel_statistics.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// Reads bags as drives and fits curves, from the linear struts that identify found.
/// @param found  by strut.  @return likewise; empty curves where nothing was found, or is not asked for.
std::vector<StrutCurves> curvesOfBags(BagOptions options, const std::vector<IdentifyResult>& found);

/// Tells people the forces at even travel rates and travels, compression beside rebound, with nine tenths of certainty.
/// @param mass  of the body [kg], for forces in N; nothing: over the mass.
void printCurves(const StrutCurves& curves, const std::optional<double>& mass);

/// Adds "damper_curve" and "spring_curve", over the body's mass.
void addCurves(const StrutCurves& curves, json& into);

/// Tells people how far and how fast a strut moves, and how its stops are used; nothing of one that does not move.
void printTravel(const TravelStatistics& travel);

/// Identifies the bag of --against with all other options as they are, and compares every strut with itself there.
/// @param now, curves  by strut, of the drives that it is compared with.
/// @return by strut `bag`, its curves there, `change` in a sentence and, with valid estimates of both, the numbers of
/// it; empty if --against is not given.
/// @throws std::invalid_argument, InputError, TooLittleError  as identify, with the bag's name before.
std::vector<json> againstOther(po::variables_map values, const std::vector<IdentifyResult>& now,
                               const std::vector<StrutCurves>& curves);

/// What the page of curves is made of.
/// @param values  of the command that makes it.  @param whole  what was found, as --json has it.
json curveFindings(const po::variables_map& values, const BagOptions& options, json whole);

}  // namespace suspension_health_monitor
