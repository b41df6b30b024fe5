#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <ros/node_handle.h>

#include <array>
#include <string_view>

#include "shell_options.h"

namespace suspension_health_monitor {

/// Settings that a user may turn while watching (rqt_reconfigure): those that change without starting estimates anew.
inline constexpr std::array<std::string_view, 7> kLiveSettings{"memory",
                                                               "health/damping_warn",
                                                               "health/damping_error",
                                                               "health/stiffness_warn",
                                                               "health/stiffness_error",
                                                               "health/confirm_time",
                                                               "publish_every"};

/// What dynamic_reconfigure::Server wants of the class that its generator would make of a .cfg file. Here names, types,
/// defaults, ranges and texts come from kMonitorFields and kShellFields, where all other settings have them from, and
/// the names are those of the launch parameters. Nothing is clamped: what is not allowed is refused by appliedTo().
class LiveSettings {
 public:
  LiveSettings() : LiveSettings(PipelineOptions{}) {}
  explicit LiveSettings(PipelineOptions options);

  /// @return the options with these settings.
  /// @throws std::invalid_argument  naming option, value and what is allowed.
  PipelineOptions appliedTo(PipelineOptions options) const;

  // The names that dynamic_reconfigure::Server calls.
  static dynamic_reconfigure::ConfigDescription __getDescriptionMessage__();
  static LiveSettings __getMin__() { return ends(&option_table::Bound::min); }
  static LiveSettings __getMax__() { return ends(&option_table::Bound::max); }
  static LiveSettings __getDefault__() { return {}; }
  void __fromServer__(
      const ros::NodeHandle& node);  ///< @throws std::invalid_argument  as PipelineOptions::fromValues()
  void __toServer__(const ros::NodeHandle& node) const;
  bool __fromMessage__(const dynamic_reconfigure::Config& message);  ///< what the message lacks stays
  void __toMessage__(dynamic_reconfigure::Config& message) const;
  void __clamp__() {}
  std::uint32_t __level__(const LiveSettings&) const { return 0; }

 private:
  /// @return every setting at that end of its range.
  static LiveSettings ends(double option_table::Bound::*end);

  OptionMap values_;  // of kLiveSettings; int or double
};

}  // namespace suspension_health_monitor
