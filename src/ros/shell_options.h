#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/monitor/monitor_settings.h"

namespace suspension_health_monitor {

/// Settings of the shell around the monitor: how readings come in and reports go out.
struct ShellOptions {
  std::string sprung_axis = "z", unsprung_axis = "z", road_axis = "z", target_frame;
  std::optional<double> sprung_range, unsprung_range, sprung_rate, unsprung_rate, max_lag;
  double input_timeout = 2.0, diagnose_window = 120.0;
  std::string effects, effects_file, model_file, baseline_file, temperature_topic;
  int publish_every = 1;
};

inline constexpr std::string_view kAxisNames = "x y z -x -y -z";

inline constexpr OptionField<ShellOptions> kShellFields[] = {
    {"input", "sprung_axis", "-", "axis of the body IMU (or of target_frame) that points up along the strut",
     &ShellOptions::sprung_axis, 0, 0, kAxisNames},
    {"input", "unsprung_axis", "-", "the same axis of the wheel carrier IMU", &ShellOptions::unsprung_axis, 0, 0,
     kAxisNames},
    {"input", "target_frame", "-",
     "frame whose axes sprung_axis and unsprung_axis name, by static transforms; empty: the IMUs' own axes",
     &ShellOptions::target_frame},
    {"input", "sprung_range", "m/s^2", "range of the body IMU: readings at its end are clipped and kept out",
     &ShellOptions::sprung_range, 1e-6, 1e6},
    {"input", "unsprung_range", "m/s^2", "range of the wheel carrier IMU, likewise", &ShellOptions::unsprung_range,
     1e-6, 1e6},
    {"input", "input_timeout", "s",
     "an IMU that is silent for longer, by the ROS clock and by the wall clock, is an error",
     &ShellOptions::input_timeout, 0.01, 3600.0},
    {"input", "max_lag", "s", "a larger mean delay of an IMU's messages behind their stamps is a warning",
     &ShellOptions::max_lag, 0.0, 3600.0},
    {"input", "expected_rate/sprung", "Hz", "rate of the body IMU; a deviation of more than 10 % is a warning",
     &ShellOptions::sprung_rate, 0.1, 1e6},
    {"input", "expected_rate/unsprung", "Hz", "rate of the wheel carrier IMU, likewise", &ShellOptions::unsprung_rate,
     0.1, 1e6},
    {"model", "effects", "-", "names of effects in the model from the start: a list, or a text with commas",
     &ShellOptions::effects},
    {"model", "model_file", "-", "YAML file with the model that the monitor starts with; ~save_model writes it",
     &ShellOptions::model_file},
    {"model", "effects_file", "-", "YAML file with laws of your own, beside the catalogue",
     &ShellOptions::effects_file},
    {"model", "diagnose/window", "s", "newest part of the drive that is kept for ~diagnose, at most 4 million samples",
     &ShellOptions::diagnose_window, 0.01, 1e6},
    {"health", "baseline_file", "-",
     "YAML file with the healthy strut: loaded if it is there, else written once learned, and by ~save_baseline",
     &ShellOptions::baseline_file},
    {"health", "temperature_topic", "-",
     "sensor_msgs/Temperature of the damper: the baseline learns how damping changes with it, and Health takes that "
     "out",
     &ShellOptions::temperature_topic},
    {"tyre", "tyre/road_axis", "-", "axis of the road's IMU (or of target_frame) that points up along the strut",
     &ShellOptions::road_axis, 0, 0, kAxisNames},
    {"output", "publish_every", "-", "publish after every n-th sample", &ShellOptions::publish_every, 1, 1000000},
};

/// What config/monitor.yaml can set.
struct PipelineOptions {
  MonitorOptions monitor;
  ShellOptions shell;

  /// @param values  by full name.
  /// @throws std::invalid_argument  naming an unknown name, or a value that is wrong and what is allowed.
  static PipelineOptions fromValues(OptionMap values) {
    PipelineOptions options;
    options.monitor = takeMonitorOptions(values);
    takeOptions(values, kShellFields, options.shell);
    refuseUnknown(values, describe());
    MonitorSettings(options.monitor).validate();
    return options;
  }

  /// @return every option that fromValues() understands, by group.
  static std::vector<OptionDescription> describe() {
    return inGroups({"input", "estimation", "model", "health", "tyre", "output"}, describeOptions(kShellFields),
                    describeOptions(kMonitorFields));
  }
};

}  // namespace suspension_health_monitor
