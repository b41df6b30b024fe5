#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <suspension_health_monitor/SetEffects.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "live_baseline.h"
#include "live_model.h"
#include "shell_options.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// The services of one live strut that change or keep what is known of it: set_effects, save_model, save_baseline,
/// reset.
class StrutServices {
 public:
  /// What they work on, called in the queue of the services.
  struct Strut {
    std::function<const SuspensionMonitor*()> monitor;  ///< nullptr: none yet
    std::function<void(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut)> set_effects;
    std::function<void(const Baseline& baseline)> set_baseline;
    std::function<std::vector<CornerSample>()> newest_samples;
    std::function<void()> model_changed;
    std::function<std::string()> reset;  ///< tells what it has done
  };

  /// @param model, baseline  of the strut; they outlive this object.
  StrutServices(ros::NodeHandle& node, const ShellOptions& options, LiveModel& model, LiveBaseline& baseline,
                Strut strut);
  ~StrutServices();
  StrutServices(const StrutServices&) = delete;
  StrutServices& operator=(const StrutServices&) = delete;

 private:
  bool onSetEffects(SetEffectsRequest& request, SetEffectsResponse& response);
  bool onSaveModel(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onSaveBaseline(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  std::optional<MotionScale> motionScaleNow() const;

  ShellOptions options_;
  LiveModel& model_;
  LiveBaseline& baseline_;
  Strut strut_;
  std::array<ros::ServiceServer, 4> services_;
};

}  // namespace suspension_health_monitor
