#pragma once

#include <array>
#include <string>
#include <vector>

#include "suspension_health_monitor/discrepancy/effect_search.h"
#include "suspension_health_monitor/monitor_options.h"

namespace suspension_health_monitor {

/// Settings of the shell around the monitor: how readings come in and reports go out.
struct ShellOptions {
  std::string sprung_axis = "z";
  std::string unsprung_axis = "z";
  double input_timeout = 2.0;
  int queue_size = 1000;
  int publish_every = 1;
  std::string hardware_id = "suspension";
  std::string effects;
  std::string model_file;
  std::string effects_file;
  double diagnose_window = 120.0;
  int diagnose_threads = SearchOptions{}.threads;
};

inline constexpr std::string_view kAxisNames = "x y z -x -y -z";

using ShellField = OptionField<ShellOptions>;
inline constexpr std::array kShellFields{
    ShellField{"sprung_axis", "-", "axis of the body IMU that points up along the strut", &ShellOptions::sprung_axis, 0,
               0, kAxisNames},
    ShellField{"unsprung_axis", "-", "axis of the wheel carrier IMU that points up along the strut",
               &ShellOptions::unsprung_axis, 0, 0, kAxisNames},
    ShellField{"input_timeout", "s", "wall time without a message of an IMU that is reported as an error",
               &ShellOptions::input_timeout, 0.01, 3600.0},
    ShellField{"queue_size", "-", "messages of either IMU that may wait for the monitor", &ShellOptions::queue_size, 1,
               1000000},
    ShellField{"publish_every", "-", "publish after every n-th sample", &ShellOptions::publish_every, 1, 1000000},
    ShellField{"hardware_id", "-", "name of the strut in /diagnostics", &ShellOptions::hardware_id},
    ShellField{"effects", "-", "names of effects in the model from the start: a list, or a text with commas",
               &ShellOptions::effects},
    ShellField{"model_file", "-", "YAML file with the model: its effects are in from the start, ~save_model writes it",
               &ShellOptions::model_file},
    ShellField{"effects_file", "-", "YAML file with laws of your own, beside the catalogue",
               &ShellOptions::effects_file},
    ShellField{"diagnose/window", "s", "newest part of the drive that is kept for ~diagnose, at most 4 million samples",
               &ShellOptions::diagnose_window, 0.01, 1e6},
    ShellField{"diagnose/threads", "-", "processor cores that ~diagnose may use", &ShellOptions::diagnose_threads, 1,
               1024},
};

/// What config/monitor.yaml can set.
struct PipelineOptions {
  MonitorOptions monitor;
  ShellOptions shell;

  /// @param values  by full name.
  /// @throws std::invalid_argument  naming an unknown name, or a value that is wrong and what is allowed.
  static PipelineOptions fromValues(OptionMap values) {
    PipelineOptions options;
    takeOptions(values, kMonitorFields, options.monitor);
    takeOptions(values, kShellFields, options.shell);
    refuseUnknown(values, describe());
    options.monitor.validate();
    return options;
  }

  /// @return every option that fromValues() understands.
  static std::vector<OptionDescription> describe() {
    std::vector<OptionDescription> all = describeOptions(kMonitorFields);
    for (OptionDescription& option : describeOptions(kShellFields)) all.push_back(std::move(option));
    return all;
  }
};

}  // namespace suspension_health_monitor
