#pragma once

#include <ros/time.h>
#include <suspension_health_monitor/ModelComparison.h>
#include <suspension_health_monitor/ParameterEstimate.h>
#include <suspension_health_monitor/SimulationTruth.h>
#include <suspension_health_monitor/SuspensionHealth.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {

/// What a message says where there is no value.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Messages to the library's types and back: the only place that knows both.

Stamp toStamp(const ros::Time& time);
ros::Time toRosTime(Stamp stamp);  ///< @pre stamp >= 0

/// @param effects  those in the model.  @param sprung_mass  [kg], for damping and stiffness in SI.
ParameterEstimate toMsg(const StrutEstimate& estimate, const char* estimator, const std_msgs::Header& header,
                        const std::vector<ActiveEffect>& effects, const std::optional<double>& sprung_mass);
/// @param frame_id  of the sprung sensor; the stamp is that of the compared sample.
ModelComparison toMsg(const ComparisonReport& comparison, const std::string& frame_id);
SuspensionHealth toMsg(const MonitorReport& report, const Baseline& baseline, const std_msgs::Header& header);
/// @param effects  of the simulated strut.  @param faults  of its readings.
SimulationTruth toMsg(const DriveTruth& truth, const std::vector<ActiveEffect>& effects,
                      const std::vector<ActiveMeasurementEffect>& faults, const std_msgs::Header& header);

}  // namespace suspension_health_monitor
