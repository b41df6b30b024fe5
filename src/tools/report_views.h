#pragma once

#include <nlohmann/json.hpp>

#include "report_page.h"

namespace suspension_health_monitor {

/// The residual of one model from all sides: where it fails in words, map, spectrum, correlations.
nlohmann::json viewsJson(const Comparison& comparison);

/// The force of every effect that was found, as it was seen and by its law.
nlohmann::json forcesJson(const ReportContent& content);

}  // namespace suspension_health_monitor
