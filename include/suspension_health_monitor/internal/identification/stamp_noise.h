#pragma once

#include <Eigen/Core>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// What stamps that are off by chance do to readings that were brought onto a grid by them: a reading x'' that is taken
/// for one of dt later is wrong by dt times the rate of x'', which is noise where the sensor shakes.
/// Cost per sample: O(1), no allocation.
class StampNoise {
 public:
  /// @param period  of the samples [s].  @param forgetting_factor  of the estimates.
  StampNoise(double period, double forgetting_factor) : period_(period), squares_(forgetting_factor) {}

  /// Takes in the next sample of an uninterrupted series.
  void add(const CornerSample& sample) {
    const Eigen::Vector2d now(sample.sprung_acceleration, sample.unsprung_acceleration);
    const Eigen::Vector2d rates = (now - before_) / period_;
    if (in_series_) squares_.add({rates[0] * rates[0], rates[1] * rates[1]});
    before_ = now;
    in_series_ = true;
  }

  /// The next sample does not follow the one before.
  void interrupt() { in_series_ = false; }

  void setForgettingFactor(double forgetting_factor) { squares_.setForgettingFactor(forgetting_factor); }

  /// @param stddevs  of the stamps' errors, of the sprung and the unsprung sensor [s].
  void setStamps(const Eigen::Vector2d& stddevs) { stddevs_ = stddevs; }

  /// @return variances of the noise if the stamps are what is irregular, of both sensors [(m/s^2)^2]; 0 if it is the
  /// readings: nobody knows.
  Eigen::Vector2d variances() const {
    return stddevs_.cwiseAbs2().cwiseProduct(Eigen::Vector2d(squares_.mean(0), squares_.mean(1)));
  }

 private:
  double period_;
  RunningMeans<2> squares_;  // of the accelerations' rates [(m/s^3)^2]
  Eigen::Vector2d before_ = Eigen::Vector2d::Zero();
  bool in_series_ = false;
  Eigen::Vector2d stddevs_ = Eigen::Vector2d::Zero();
};

}  // namespace suspension_health_monitor
