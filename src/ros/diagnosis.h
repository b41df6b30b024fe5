#pragma once

#include <suspension_health_monitor/Diagnose.h>

#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {

/// What a live search works on.
struct SearchTask {
  Drive drive;
  DiagnoseOptions options;
};

/// diagnose() of one drive.
/// @throws std::runtime_error  in words for people, if the samples are too short or too poor.
Diagnosis searchEffects(const SearchTask& task);

/// The answer of ~diagnose: the whole result as plain fields.
DiagnoseResponse toResponse(const Diagnosis& found);

}  // namespace suspension_health_monitor
