#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "suspension_health_monitor/internal/health/inspection.h"

namespace suspension_health_monitor {

/// What `inspect` knows of a vehicle, and tells.
struct Inspected {
  std::vector<InspectedStrut> struts;
  double seconds;  ///< of data
  Inspection result;
};

/// @return the verdict and what fails, or what is not known.
std::string summaryOf(const Inspected& inspected);

/// Tells people every number and the verdict.
void printInspection(const Inspected& inspected);

json toJson(const Inspected& inspected);

/// @param values  of the command.  @param bags  their paths.
/// @return the page, one sheet of A4 without a script.
std::string pageOf(const Inspected& inspected, const po::variables_map& values, const std::vector<std::string>& bags);

}  // namespace suspension_health_monitor
