#pragma once

#include "suspension_health_monitor/internal/every_n.h"
#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/vehicle/coupling_rows.h"
#include "suspension_health_monitor/internal/vehicle/coupling_solver.h"

namespace suspension_health_monitor {

/// Estimates how the struts of a vehicle move one another from the rows of all of them over a long memory, for rho does
/// not wear: CouplingRows -> moments, in which a row that is far off counts less -> CouplingSolver.
///
/// Tracks that are alike move struts alike: then the rows' information of some combination of struts is not clear of
/// that of noise, and nothing is known. Nothing is forgotten while what there is does not tell the ratios, as on calm
/// roads or while the vehicle stands. Cost per sample: O(N) and, every eighth of a horizon, O(N^2); no allocation.
class CouplingEstimator {
 public:
  /// @param memory  of the rows [samples], the least.
  CouplingEstimator(const CouplingColumns& columns, const IntegralFilterOptions& filter, double memory,
                    const SensorNoise& noise);

  /// From the next solve() on. Allocates.
  void setNoise(const SensorNoise& noise) { solver_.setNoise(momentsOfNoise(columns_, filter_, noise)); }

  /// Takes in the next sample of an uninterrupted uniform series.
  void add(const VehicleSample& sample);

  /// After a gap.
  void startNewSeries() { rows_.startNewSeries(); }

  /// @return what is known by now; O(N^3).
  const CouplingEstimate& solve();

  const CouplingEstimate& estimate() const { return solver_.estimate(); }

 private:
  double weightOf(const CouplingRow& row);

  CouplingColumns columns_;
  IntegralFilterOptions filter_;
  CouplingRows rows_;
  EveryN row_due_;
  double forgetting_factor_;  // of a row that is taken
  CouplingRow mean_;          // of the rows
  CouplingMoments moments_;   // mean of row row'
  double weight_ = 0.0;
  LimitedMean usual_rest_;
  CouplingSolver solver_;
};

}  // namespace suspension_health_monitor
