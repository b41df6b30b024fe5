#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// An effect that some drives cannot tell, and what is empty in one of them.
struct UntestableEffect {
  std::string name;
  BodyChannel missing;
};

/// Takes the effects out of `library` all of whose channels are empty in one of the records. One that is left is
/// enough: the coefficients of the others stay 0.
std::vector<UntestableEffect> takeUntestable(EffectLibrary& library, const Records& records);

/// @return a fault of the model with a coefficient that is not 0 and goes with a channel that is empty, if there is
/// one.
std::optional<UntestableEffect> findUntestable(const StrutModel& model, const Records& records);

}  // namespace suspension_health_monitor
