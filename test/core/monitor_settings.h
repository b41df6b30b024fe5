#pragma once

#include <optional>

#include "suspension_health_monitor/monitor_options.h"

namespace suspension_health_monitor {

/// The defaults at the paper's sampling time.
inline MonitorOptions liveOptions() {
  MonitorOptions options;
  options.sample_period = 0.02;
  return options;
}

/// The defaults with other forgetting factors.
inline MonitorOptions optionsWith(double slow, std::optional<double> fastest) {
  MonitorOptions options = liveOptions();
  options.forgetting_factor = slow;
  options.fastest_forgetting_factor = fastest;
  return options;
}

/// Section 3.2 and 4 of the paper, as in config/paper.yaml.
inline MonitorOptions paperOptions() {
  MonitorOptions options;
  options.sample_period = 0.02;
  options.horizon_samples = 30;
  options.integration_rule = "trapezoid";
  options.forgetting_factor = 0.98;
  options.forgetting_rule = "exponential";
  options.initial_variance = 1e5;
  options.initial_variance_rule = "absolute";
  options.la_start_rows = 150;
  options.la_small_divisor_rule = "absolute";
  options.la_small_divisor = 1e-8;
  options.la_scale_covariance_at_start = false;
  return options;
}

}  // namespace suspension_health_monitor
