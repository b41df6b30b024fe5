#pragma once

#include <vector>

#include "suspension_health_monitor/internal/vehicle/coupling_estimator.h"

namespace suspension_health_monitor {

/// Couplings by integral filters of several horizons, a factor of two apart: from that of a stiff robot to that of a
/// soft bus. The one with the least doubt is taken, where doubt is also what it differs from the next longer one,
/// beyond what the scatter of both accounts for (Hausman's test of a specification, Econometrica 46 (1978), 1251-1271):
/// few samples in a horizon, or motion beyond half the rate, make an error that no amount of rows shows. Cost per
/// sample: that of a CouplingEstimator for each.
class CouplingSurvey {
 public:
  /// @param period  T [s].  @param memory  of the rows [s]; infinite: all count.
  /// @throws std::invalid_argument  if no horizon has samples enough.
  CouplingSurvey(const CouplingColumns& columns, double period, double memory, const SensorNoise& noise);

  /// From the next solve() on. Allocates.
  void setNoise(const SensorNoise& noise);

  void add(const VehicleSample& sample);
  void startNewSeries();

  /// @return the best of what is known by now; O(N^3) for each horizon.
  const CouplingEstimate& solve();

  /// @return what was solved last.
  const CouplingEstimate& estimate() const { return best_; }

 private:
  std::vector<CouplingEstimator> estimators_;
  CouplingEstimate best_;
};

}  // namespace suspension_health_monitor
