#include "command.h"

namespace suspension_health_monitor {

void horizon(const Arguments&) {}

}  // namespace suspension_health_monitor
