#pragma once

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// compare() of drives that are prepared already; without words for people.
/// @param options  its period and model are not looked at.
Comparison compareModel(const Records& records, const StrutModel& model, const CompareOptions& options = {});

}  // namespace suspension_health_monitor
