#pragma once

#include <string>

#include "suspension_health_monitor/internal/option_table.h"

namespace suspension_health_monitor {

/// When a simulated drive is published, and how it is recorded.
struct PlayingOptions {
  double start_time = 0.0;
  double real_time_factor = 1.0;
  bool publish_clock = false;
  bool shutdown_at_end = false;
  std::string record;
  std::string record_topics =
      "/monitor/estimate /monitor/ls /monitor/la /monitor/comparison /monitor/health /simulator/truth";
};

inline constexpr OptionField<PlayingOptions> kPlayingFields[] = {
    {"playing", "start_time", "s", "stamp at the start of the drive; live without publish_clock it is now",
     &PlayingOptions::start_time, 0.0, 4e9},
    {"playing", "real_time_factor", "-", "drive seconds per wall second; 0: as fast as subscribers keep up",
     &PlayingOptions::real_time_factor, 0.0, 1e6},
    {"playing", "publish_clock", "-", "drive /clock, for nodes with use_sim_time", &PlayingOptions::publish_clock},
    {"playing", "record", "-", "bag to record the drive into, every message of it; empty: none",
     &PlayingOptions::record},
    {"playing", "record_topics", "-", "what to record, with spaces; the drive begins once all are published",
     &PlayingOptions::record_topics},
    {"playing", "shutdown_at_end", "-", "shut the node or the nodelet manager down after the drive",
     &PlayingOptions::shutdown_at_end},
};

}  // namespace suspension_health_monitor
