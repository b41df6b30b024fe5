#include "suspension_health_monitor/internal/record/sampling_limit.h"

#include "suspension_health_monitor/internal/signal/sampling_limit_power.h"

namespace suspension_health_monitor {

double powerAtSamplingLimit(const Records& records) {
  SamplingLimitPower power(1.0);
  for (const DriveSegment* segment : segmentsOf(records)) {
    power.startNewSeries();
    for (const double value : segment->unsprung) power.add(value);
  }
  return power.density();
}

}  // namespace suspension_health_monitor
