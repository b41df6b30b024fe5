#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/internal/vehicle/body_over_wheel.h"
#include "suspension_health_monitor/internal/vehicle/imu_spectra.h"
#include "suspension_health_monitor/internal/vehicle/imu_survey.h"

namespace suspension_health_monitor {

/// What the command check knows of a topic.
struct CheckedImu {
  std::string topic;
  ImuSurvey survey = {};
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< of its axes the one that points up, with its sign
  bool by_gravity = false;                        ///< else `up` is the axis that moves most, of either sign
  bool has_gyro = false;

  int axis() const;  ///< 0 x, 1 y, 2 z
  /// @return one of kAxisNames.
  std::string upAxis() const { return (up[axis()] < 0.0 ? "-" : "") + std::string(1, "xyz"[axis()]); }
};

/// The IMUs of bags: what each of them is like, what points up, and which is which.
struct CheckedImus {
  /// @param asked  topics of IMUs; none: all of a bag are meant.
  /// @param target_frame  whose axes count instead of the IMUs' own; empty: none. The bags have the transforms.
  /// @throws InputError  as readTopics(), or without any IMU.
  CheckedImus(const ImuBags& bags, const std::vector<BagTopic>& asked, const std::string& target_frame = "");

  /// @return what is the matter with an IMU and what to do, in a sentence; empty: nothing is.
  std::string faultOf(std::size_t imu) const;
  std::string sentenceOf(const BodyOverWheel& pair) const;
  json toJson() const;

  std::vector<CheckedImu> imus;
  TopicGaps gaps{ShellOptions().input_timeout};
  std::vector<BodyOverWheel> pairs;

 private:
  std::size_t placeOf(const std::string& topic);
  void orient();
  double moved(std::size_t imu, const double (&band)[2]) const;

  std::optional<ImuSpectra> spectra;
};

/// What `check` says of the IMUs that a command has read, as its JSON has it: for the first box of every page.
json dataJson(const BagOptions& options);

}  // namespace suspension_health_monitor
