#pragma once

#include <Eigen/Core>

namespace suspension_health_monitor {

/// What is wrong with the readings of a strut's sprung and unsprung sensor that were resampled; 0 of paired ones.
struct ResamplingErrors {
  Eigen::Vector2d times = Eigen::Vector2d::Zero();  ///< standard deviation of when they were taken [s]
  Eigen::Vector2d lost = Eigen::Vector2d::Zero();   ///< share that is not there, and was interpolated [-]
};

}  // namespace suspension_health_monitor
