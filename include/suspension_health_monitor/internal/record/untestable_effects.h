#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// An effect that some drives cannot tell, and what is empty in one of them.
struct UntestableEffect {
  std::string name;
  BodyChannel missing;
};

/// Takes the effects out of `library` that need a channel which is empty in one of the records.
std::vector<UntestableEffect> takeUntestable(EffectLibrary& library, const Records& records);

}  // namespace suspension_health_monitor
