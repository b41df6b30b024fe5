#pragma once

#include <nlohmann/json.hpp>

#include "report_page.h"

namespace suspension_health_monitor {

/// What the page tells of every candidate, by name: law, units, what a workshop would find, force or reading.
nlohmann::json effectsJson(const EffectLibrary& library);

/// Parameters before and after, with their standard deviations.
nlohmann::json parametersJson(const ReportContent& content);

}  // namespace suspension_health_monitor
