#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <ros/node_handle.h>

#include <array>
#include <cmath>
#include <string_view>

#include "shell_options.h"

namespace suspension_health_monitor {

/// A setting that a user may turn while watching, and the part of what is allowed that a slider shows: of more, a
/// slider's step would be larger than what one wants to set.
struct LiveSetting {
  std::string_view name;
  double min, max;  ///< of the slider
};

/// Those that change without starting estimates anew.
inline constexpr std::array kLiveSettings{
    LiveSetting{"memory", 0.1, 30.0},
    LiveSetting{"health/damping_warn", 0.01, 1.0},
    LiveSetting{"health/damping_error", 0.01, 1.0},
    LiveSetting{"health/stiffness_warn", 0.01, 1.0},
    LiveSetting{"health/stiffness_error", 0.01, 1.0},
    LiveSetting{"health/confirm_time", 0.0, 10.0},
    LiveSetting{"health/payload_range", 0.0, 1.0},
    LiveSetting{"health/oldest_data", 1.0, 3600.0},
    LiveSetting{"publish_every", 1.0, 100.0},
};

/// What dynamic_reconfigure::Server wants of the class that its generator would make of a .cfg file. Here names,
/// groups, types, defaults and texts come from kMonitorFields and kShellFields, where all other settings have them
/// from, and the names are those of the launch parameters. Nothing is clamped to a slider: what is not allowed is
/// refused by appliedTo(), and a slider reaches as far as what was given at the start.
class LiveSettings {
 public:
  LiveSettings() : LiveSettings(PipelineOptions{}) {}
  explicit LiveSettings(PipelineOptions options);

  /// @return the options with these settings.
  /// @throws std::invalid_argument  naming option, value and what is allowed.
  PipelineOptions appliedTo(PipelineOptions options) const;

  /// @return every setting at that end of its slider, or as it is where it lies beyond.
  LiveSettings lowerEnds() const { return atEnds(&LiveSetting::min, &std::fmin); }
  LiveSettings upperEnds() const { return atEnds(&LiveSetting::max, &std::fmax); }

  // The names that dynamic_reconfigure::Server calls.
  static dynamic_reconfigure::ConfigDescription __getDescriptionMessage__();
  static LiveSettings __getMin__() { return LiveSettings().lowerEnds(); }
  static LiveSettings __getMax__() { return LiveSettings().upperEnds(); }
  static int __getParamDescriptions__() { return 0; }  // they are always those of __getDescriptionMessage__()
  static int __getGroupDescriptions__() { return 0; }
  static LiveSettings __getDefault__() { return {}; }
  void __fromServer__(
      const ros::NodeHandle& node);  ///< @throws std::invalid_argument  as PipelineOptions::fromValues()
  void __toServer__(const ros::NodeHandle& node) const;
  void __fromMessage__(const dynamic_reconfigure::Config& message);  ///< what the message lacks stays
  void __toMessage__(dynamic_reconfigure::Config& message) const;
  void __toMessage__(dynamic_reconfigure::Config& message, int, int) const { __toMessage__(message); }
  void __clamp__() {}
  std::uint32_t __level__(const LiveSettings&) const { return 0; }

 private:
  /// @param beyond  of a setting and the end of its slider the one that is farther out.
  LiveSettings atEnds(double LiveSetting::*end, double (*beyond)(double, double)) const;

  OptionMap values_;  // of kLiveSettings; int or double
};

}  // namespace suspension_health_monitor
