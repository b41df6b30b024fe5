#pragma once

#include <optional>

#include "suspension_health_monitor/internal/monitor_settings.h"

namespace suspension_health_monitor {

/// The defaults at the paper's sampling time.
inline MonitorSettings liveOptions() {
  MonitorSettings options;
  options.sample_period = 0.02;
  return options;
}

/// @return the memory at the paper's sampling time that forgets by this factor [s].
inline double memoryOf(double forgetting_factor) { return 0.02 / (1.0 - forgetting_factor); }

/// The defaults with other forgetting factors.
inline MonitorSettings optionsWith(double slow, std::optional<double> fastest) {
  MonitorSettings options = liveOptions();
  options.forgetting_factor = slow;
  if (fastest) options.fastest_memory = memoryOf(*fastest);
  return options;
}

/// Section 3.2 and 4 of the paper, as in config/paper.yaml.
inline MonitorSettings paperOptions() {
  MonitorSettings options = MonitorOptions::of("paper");
  options.sample_period = 0.02;
  return options;
}

}  // namespace suspension_health_monitor
