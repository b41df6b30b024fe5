#pragma once

#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// What the integral filter makes of the wheel's acceleration.
struct WheelRow {
  double output;     ///< I_2^2 w'' [m/s^2]
  double damping;    ///< I_1^2 w'' [m/s]
  double stiffness;  ///< I_0^2 w'' [m]
};

/// The wheel's part of the rows, also between samples and a little before and after the row: each of the three is the
/// derivative of the next one, so that cubic Hermite interpolation is 0.5 % off at most for a wheel that shakes at a
/// fifth of the rate. What comes after a row has to be known, so rows are delay() samples late.
/// Cost per push: O(1), no allocation.
class WheelHistory {
 public:
  /// @param reach  of at(), before and after a row [s].
  WheelHistory(const IntegralFilterOptions& options, double reach);

  void push(double acceleration);

  /// @return true once all that at() may ask for is known: a window of the filter and 2 delay() samples have been
  /// pushed.
  bool full() const { return missing_ == 0; }

  int delay() const { return delay_; }  ///< of a row behind the newest sample [samples]

  /// A time near the row.
  struct Place {
    int age;                           // of the sample after it
    double before, after;              // weights of the values there, and of the slopes [s]
    double slope_before, slope_after;  // likewise
    double share;                      // of the way from the sample before to the one after
  };

  /// @param shift  after the row, within the reach [s].
  Place place(double shift) const;

  WheelRow at(const Place& place) const {
    const auto between = [&](const DelayLine& values, const DelayLine& slopes) {
      return place.before * values.at(place.age + 1) + place.after * values.at(place.age) +
             place.slope_before * slopes.at(place.age + 1) + place.slope_after * slopes.at(place.age);
    };
    return {(1.0 - place.share) * output_.at(place.age + 1) + place.share * output_.at(place.age),
            between(damping_, output_), between(stiffness_, damping_)};
  }

  /// @return that of the newest sample.
  WheelRow newest() const { return {output_.at(0), damping_.at(0), stiffness_.at(0)}; }

  void reset();

 private:
  LinearIntegralFilter filter_;
  double period_;
  int delay_;
  int missing_;  // samples until it is full, once the filter is
  DelayLine output_, damping_, stiffness_;
};

}  // namespace suspension_health_monitor
