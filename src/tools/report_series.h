#pragma once

#include <nlohmann/json.hpp>

#include "report_page.h"

namespace suspension_health_monitor {

/// The drives over time: measured z'' and the residuals before and after, packed as 16-bit numbers, with the stretches
/// that were held out and a window that is worth looking at first.
nlohmann::json drivesJson(const ReportContent& content);

}  // namespace suspension_health_monitor
