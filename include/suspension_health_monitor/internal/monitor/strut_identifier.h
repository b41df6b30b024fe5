#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"
#include "suspension_health_monitor/internal/identification/regression.h"
#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/monitor/validity_gate.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// The paper's estimation, row by row: integral filter and regression rows (9), (28)-(30), then LS (15)-(17) and LA
/// (24)-(26) side by side, with the same columns: b1, b0, one per effect, then those of the sensors' offset. They
/// forget by the same factor, and LS shows whether LA is lost. Cost per sample: O(1) whatever the horizon; no
/// allocation.
class StrutIdentifier {
 public:
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  explicit StrutIdentifier(const MonitorSettings& options);

  /// The same of the wheel, Eq. (2), m w'' = beta (z' - w') + K (z - w) + K0 (mu - w), likewise differentiated twice:
  ///   I_2^2 w'' = -(beta/m) I_1^2 u - (K/m) I_0^2 u + (K0/m) I_0^2 (mu'' - w'') + e,   u = w'' - z'' [m/s^2].
  /// The wheel is to the body what the body is to the wheel: the caller swaps both readings of a sample, and gives
  /// mu'' - w'' as the force of an effect. A constant common to all sensors vanishes. Without changeModel().
  static StrutIdentifier ofWheel(MonitorSettings options);

  /// Goes on with another model: one column for each beside b1 and b0. Allocates.
  /// @param columns  where b1, b0 and the effects' coefficients come from.
  void changeModel(std::vector<ColumnOrigin> columns);

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @param effect_forces  f_j at this sample, one per effect.
  void add(const CornerSample& sample, const double* effect_forces);

  /// The newest sample gives no row: the free run has no travel yet.
  void skip() { has_row_ = false; }

  /// While rows tell nothing of the strut, as of a parked vehicle, the estimates stay as they are.
  void hold(bool holds) { holds_ = holds && !forgets_unexcited_; }

  /// Writes what is known now, all but the doubt.
  void write(StrutEstimate& ls, StrutEstimate& la) const;

  /// @param estimate  as written, of either estimator.  @param of_input  what is known of the input.
  EstimateFacts facts(const StrutEstimate& estimate, const EstimateFacts& of_input) const;

  bool hasRow() const { return has_row_; }  ///< of the newest sample
  bool holds() const { return holds_; }

  /// @return false once the outputs of a horizon of rows in succession are exactly 0: without any noise there is no
  /// motion, but a sensor that is stuck or a simulated vehicle at rest.
  bool moves() const { return silent_rows_ < filter_.horizon_samples; }

  /// A gap, or another drive: the filter fills anew.
  void startNewSeries();

  /// Estimates are not valid until enough rows of the new model have come.
  void restartValidity() { rows_ = 0.0; }

  /// From the next row on; the estimates stay.
  /// @param options  of which memory and forgetting_factor count.
  /// @throws std::invalid_argument  as RecursiveLeastSquares.
  void setForgetting(const MonitorSettings& options);

  /// @return the factor that rows are forgotten by.
  double forgettingFactor() const { return least_absolute_.forgettingFactor(); }

  /// @return c_j of LA [unit of the effect's coefficient].
  double coefficient(std::size_t j) const { return least_absolute_.parameters()[kNumStrutParameters + j]; }

 private:
  /// @param num_accelerations  columns of accelerations, beside those of the strut.
  StrutIdentifier(const MonitorSettings& options, const IntegralFilterOptions& filter, int num_accelerations);

  int numModelColumns() const { return least_absolute_.numParameters() - offset_columns_; }
  void update(const RegressionRow& row);

  /// Calls act(estimator) with each.
  template <class Act>
  void forEach(const Act& act) {
    for (RecursiveLeastSquares* each : std::initializer_list<RecursiveLeastSquares*>{&least_squares_, &least_absolute_})
      act(*each);
  }

  IntegralFilterOptions filter_;
  int offset_columns_;      // the last ones, of the sensors
  bool forgets_unexcited_;  // true: rows of a parked vehicle count, too
  SuspensionRegression regression_;
  RecursiveLeastSquares least_squares_;
  RecursiveLeastAbsolute least_absolute_;
  double lost_memories_ = 0.0;  // for which LS's mean residual has been below half of LA's
  int silent_rows_ = 0;         // without a break; counts up to the horizon and stays there
  bool has_row_ = false;
  bool holds_ = false;
  double rows_;               // of the model's present columns
  double fewest_rows_ = 0.0;  // of a valid estimate
};

}  // namespace suspension_health_monitor
