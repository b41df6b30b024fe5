#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/filters.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

namespace suspension_health_monitor {

/// From the streams of a vehicle to what all its struts do, some measured at the strut's top, others from one six-axis
/// IMU anywhere on the body: with the body turning at omega, alpha = omega',
///     z_i'' = [a + alpha x r_i + omega x (omega x r_i)]_z
///           = a_z + alpha_x y_i - alpha_y x_i + omega_z (omega_x x_i + omega_y y_i) - (omega_x^2 + omega_y^2) z_i.
/// Gravity in a belongs to z_i'' as it would in the reading of an IMU there.
///
/// alpha comes from a MotionFilter, and everything else passes the same low-pass filter, the products of the angular
/// rates after they have been formed: then all of them are still those of one motion. What the wheels do is known
/// beside it as it was, for models whose laws are not linear. Where no strut needs the body's IMU nothing is filtered
/// or late. Cost per instant: O(struts), no allocation.
class StrutTops {
 public:
  /// @param period  T > 0.
  /// @throws std::invalid_argument  if a strut has neither a sprung stream nor a body IMU, or if there are more struts
  /// or forces than a VehicleSample holds.
  StrutTops(Stamp period, const VehicleChannels& channels);

  /// @return the sample delay() instants ago, valid until the next call; nullptr while the filter fills, at the start
  /// and after a gap.
  const VehicleSample* push(const GridInstant& instant);

  /// @return samples by which a sample is late.
  int delay() const { return filter_ ? filter_->delay() : 0; }

  /// @return taps of the low-pass filter that samples have passed; none: nothing is filtered.
  std::vector<double> lowPass() const {
    if (!filter_) return {};
    return {filter_->lowPass().data(), filter_->lowPass().data() + filter_->lowPass().size()};
  }

 private:
  void collect(const GridInstant& instant);
  void spread(const std::vector<double>& values, const std::vector<double>& rates);

  VehicleChannels channels_;
  std::optional<MotionFilter> filter_;
  std::vector<double> signals_;  // of one instant, in the order that collect() gives them
  VehicleSample sample_;
};

}  // namespace suspension_health_monitor
