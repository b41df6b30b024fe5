#pragma once

#include <suspension_health_monitor/Diagnose.h>

#include <functional>

#include "diagnose_service.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {

/// What a live search works on.
struct SearchTask {
  Drive drive;
  DiagnoseOptions options;
};

/// @param window  [s] as asked for, 0: everything.  @param kept  [s] diagnose_window.
/// @return how far back to look [s].
/// @throws std::invalid_argument  naming the window and what is allowed.
double searchSpan(double window, double kept);

/// An answer of ~diagnose without one: every figure is NaN.
DiagnoseResponse withoutFigures();

/// The answer of ~diagnose: the whole result as plain fields.
DiagnoseResponse toResponse(const Diagnosis& found);

/// diagnose() as the work of ~diagnose.
/// @param take  what is done with the result in the nodelet's queue.
DiagnoseService<Diagnose>::Search searchOf(SearchTask task, std::function<void(const Diagnosis&)> take);

}  // namespace suspension_health_monitor
