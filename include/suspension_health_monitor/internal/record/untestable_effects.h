#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Takes the effects out of `library` all of whose channels are empty in one of the records. One that is left is
/// enough: the coefficients of the others stay 0.
/// @return their names, and what is empty.
std::vector<std::pair<std::string, BodyChannel>> takeUntestable(EffectLibrary& library, const Records& records);

/// @return a fault of the model with a coefficient that is not 0 and goes with a channel that is empty, if there is
/// one: its name, and that channel.
std::optional<std::pair<std::string, BodyChannel>> findUntestable(const StrutModel& model, const Records& records);

}  // namespace suspension_health_monitor
