#pragma once

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/identify.h"

namespace suspension_health_monitor {

inline constexpr const char* kAgainst = "against";  ///< name of an option

/// Identifies the bag of --against with all other options as they are, and compares every strut with itself there.
/// @param now, curves  by strut, of the drives that it is compared with.
/// @return by strut `bag`, its curves there, `change` in a sentence and, with valid estimates of both, the numbers of
/// it; empty if --against is not given.
/// @throws std::invalid_argument, InputError, TooLittleError  as identify, with the bag's name before.
std::vector<nlohmann::json> againstOther(boost::program_options::variables_map values,
                                         const std::vector<IdentifyResult>& now,
                                         const std::vector<StrutCurves>& curves);

}  // namespace suspension_health_monitor
