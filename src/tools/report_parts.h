#pragma once

#include <nlohmann/json.hpp>

#include "report_page.h"

namespace suspension_health_monitor {

/// The drives over time: measured z'' and the residuals before and after, packed as 16-bit numbers, with the stretches
/// that were held out and a window that is worth looking at first.
nlohmann::json drivesJson(const ReportContent& content);

/// What the page tells of every candidate, by name: law, units, what a workshop would find, force or reading.
nlohmann::json effectsJson(const EffectLibrary& library);

/// Parameters before and after, with their standard deviations.
nlohmann::json parametersJson(const ReportContent& content);

/// The force of every effect that was found, as it was seen and by its law.
nlohmann::json forcesJson(const ReportContent& content);

/// How to put the model to use: the text of its file, and what to type.
nlohmann::json addingJson(const ReportContent& content);

}  // namespace suspension_health_monitor
