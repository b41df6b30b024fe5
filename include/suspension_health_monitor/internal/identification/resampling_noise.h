#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/resampling_errors.h"
#include "suspension_health_monitor/internal/signal/sliding_window.h"

namespace suspension_health_monitor {

/// What readings that were brought onto a grid are wrong by, which is noise where the sensor shakes:
/// - A reading x'' that is taken for one of dt later is wrong by dt times the rate of x''.
/// - One that is lost and interpolated is wrong by what its neighbours do not tell of it: a sixth of the fourth
///   difference, if a cubic goes through two of them on either side.
/// Cost per sample: O(1), no allocation.
class ResamplingNoise {
 public:
  /// @param period  of the samples [s].  @param forgetting_factor  of the estimates.
  ResamplingNoise(double period, double forgetting_factor) : period_(period), squares_(forgetting_factor) {}

  /// Takes in the next sample of an uninterrupted series.
  /// @param is_row  the estimates rest on it, too: they remember nothing of a vehicle that is parked.
  void add(const CornerSample& sample, bool is_row) {
    newest_[0].push(sample.sprung_acceleration);
    newest_[1].push(sample.unsprung_acceleration);
    if (!is_row || !newest_[0].full()) return;
    std::array<double, kNumSquares> squares;
    for (std::size_t i = 0; i < 2; ++i) {
      const double* x = newest_[i].data();
      const double rate = (x[3] - x[2]) / period_, untold = x[2] - (4.0 * (x[1] + x[3]) - x[0] - x[4]) / 6.0;
      squares[kRate + i] = rate * rate;
      squares[kUntold + i] = untold * untold;
    }
    squares_.add(squares);
  }

  /// The next sample does not follow the one before.
  void interrupt() {
    for (auto& each : newest_) each.clear();
  }

  void setForgettingFactor(double forgetting_factor) { squares_.setForgettingFactor(forgetting_factor); }

  void setErrors(const ResamplingErrors& errors) { errors_ = errors; }

  /// @return its variances, of both sensors [(m/s^2)^2].
  Eigen::Vector2d variances() const {
    const auto square = [&](std::size_t which) {
      return Eigen::Array2d(squares_.mean(which), squares_.mean(which + 1));
    };
    return errors_.times.array().square() * square(kRate) + errors_.lost.array() * square(kUntold);
  }

 private:
  enum Square : std::size_t { kRate = 0, kUntold = 2, kNumSquares = 4 };  // of the body, then of the wheel

  double period_;
  std::array<SlidingWindow<5>, 2> newest_;
  RunningMeans<kNumSquares> squares_;
  ResamplingErrors errors_;
};

}  // namespace suspension_health_monitor
