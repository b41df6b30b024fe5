#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_over_wheel.h"
#include "suspension_health_monitor/internal/vehicle/imu_survey.h"

namespace suspension_health_monitor {

/// What the command check knows of a topic.
struct CheckedImu {
  std::string topic;
  ImuSurvey survey = {};
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< of its axes the one that points up, with its sign
  bool by_gravity = false;                        ///< else `up` is the axis that moves most, of either sign
  bool has_gyro = false;

  int axis() const;            ///< 0 x, 1 y, 2 z
  std::string upAxis() const;  ///< one of kAxisNames
};

/// @return `suspension_bag identify` with the bags and all that the pairs need.
/// @param file  that --write names, or a name for it.
std::string nextCommand(const std::vector<CheckedImu>& imus, const std::vector<BodyOverWheel>& pairs,
                        const std::vector<std::string>& bags, const std::string& file);

/// @return the text of --write: of one strut settings, of several a vehicle file.
std::string fileOf(const std::vector<CheckedImu>& imus, const std::vector<BodyOverWheel>& pairs,
                   const std::vector<std::string>& bags, const std::string& file);

}  // namespace suspension_health_monitor
