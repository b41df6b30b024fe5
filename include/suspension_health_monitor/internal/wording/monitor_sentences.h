#pragma once

#include <string>

#include "suspension_health_monitor/internal/health/assessment.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/signal/alignment_judge.h"

namespace suspension_health_monitor {

/// What the live monitor has found, in words for people.

/// @return why readings are resampled; empty if pairing does well.
std::string describe(AlignmentJudge::Verdict verdict);

/// @return why an estimate is not valid.
std::string describe(EstimateDoubt doubt);

/// @return what is wrong with the sensors; empty for kNone.
std::string describe(const SensorReport& report);

/// @return the report in one sentence, e.g. "damping 31 % below baseline (12 sigma), stiffness at baseline".
std::string describe(const HealthReport& report);

/// @return likewise, e.g. "rear_left damping 28 % below the other corners: damage".
std::string describe(const CornerComparisonReport& report);

}  // namespace suspension_health_monitor
