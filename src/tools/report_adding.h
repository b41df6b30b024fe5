#pragma once

#include <nlohmann/json.hpp>

#include "report_page.h"

namespace suspension_health_monitor {

/// How to put the model to use: the text of its file, and what to type.
nlohmann::json addingJson(const ReportContent& content);

}  // namespace suspension_health_monitor
