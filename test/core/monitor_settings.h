#pragma once

#include "suspension_health_monitor/internal/monitor/monitor_settings.h"

namespace suspension_health_monitor {

/// The defaults at the paper's sampling time.
inline MonitorSettings liveOptions() {
  MonitorSettings options;
  options.sample_period = 0.02;
  return options;
}

/// Section 3.2 and 4 of the paper, as in config/paper.yaml.
inline MonitorSettings paperOptions() {
  MonitorSettings options = MonitorOptions::of("paper");
  options.sample_period = 0.02;
  return options;
}

}  // namespace suspension_health_monitor
