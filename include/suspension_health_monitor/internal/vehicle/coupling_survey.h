#pragma once

#include <vector>

#include "suspension_health_monitor/internal/vehicle/coupling_estimator.h"

namespace suspension_health_monitor {

/// Couplings by integral filters of several horizons, a factor of two apart: from that of a stiff robot to that of a
/// soft bus. The one with the least doubt is taken. Cost per sample: that of a CouplingEstimator for each.
class CouplingSurvey {
 public:
  /// @param period  T [s].  @param memory  of the rows [s]; infinite: all count.
  /// @throws std::invalid_argument  if no horizon has samples enough.
  CouplingSurvey(int num_struts, int num_forces, double period, double memory, const SensorNoise& noise);

  void setNoise(const SensorNoise& noise);

  void add(const VehicleSample& sample);
  void startNewSeries();

  /// @return the best of what is known by now; O(N^3) for each horizon.
  const CouplingEstimate& solve();

  /// @return what was solved last.
  const CouplingEstimate& estimate() const { return estimators_[best_].estimate(); }

 private:
  std::vector<CouplingEstimator> estimators_;
  std::size_t best_ = 0;
};

}  // namespace suspension_health_monitor
