#include "suspension_health_monitor/internal/health/agreement.h"

#include "suspension_health_monitor/internal/monitor/validity_gate.h"

namespace suspension_health_monitor {

void Agreement::update(const StrutEstimate& ls, const StrutEstimate& la) {
  failing_ += ((agree(ls, la) ? 0.0 : 1.0) - failing_) / kMemory;
}

}  // namespace suspension_health_monitor
