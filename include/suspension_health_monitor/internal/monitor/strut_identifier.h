#pragma once

#include <array>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/every_n.h"
#include "suspension_health_monitor/internal/identification/excitation.h"
#include "suspension_health_monitor/internal/identification/noise_level.h"
#include "suspension_health_monitor/internal/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/identification/stamp_noise.h"
#include "suspension_health_monitor/internal/identification/synchronous_regression.h"
#include "suspension_health_monitor/internal/identification/variable_forgetting.h"
#include "suspension_health_monitor/internal/monitor/silent_rows.h"
#include "suspension_health_monitor/internal/monitor/validity_gate.h"
#include "suspension_health_monitor/internal/monitor_settings.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// The estimation itself: regression rows of a series of samples, LS and LA of them side by side, and what the rows
/// tell of the strut (Excitation). Rows that tell nothing are only observed, so that the estimates stay.
/// Whether an estimate may be trusted is decided elsewhere, by facts().
/// Cost per sample: O(1) whatever the horizon; no allocation.
class StrutIdentifier {
 public:
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  explicit StrutIdentifier(const MonitorSettings& options);

  /// Goes on with other effects: one column for each beside b1 and b0. Allocates.
  /// @param effects  where their coefficients come from; numbers before the change count from the first effect.
  void changeEffects(const std::vector<ColumnOrigin>& effects);

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @param effect_forces  f_j at this sample, one per effect.
  void add(const CornerSample& sample, const double* effect_forces);

  /// No row comes of the newest sample.
  void skip() { has_row_ = false; }

  /// Writes what is known now, all but the doubt.
  void describe(StrutEstimate& ls, StrutEstimate& la);

  /// @param estimate  as described, of either estimator.
  EstimateFacts facts(const StrutEstimate& estimate) const;

  /// What is learned of the strut and of the estimates' scatter is learned while they are valid.
  void noteValidity(const StrutEstimate& ls, const StrutEstimate& la);

  bool hasRow() const { return has_row_; }  ///< of the newest sample

  /// @return true while rows tell nothing of the strut, and are only observed.
  bool holdsAll() const;

  void startNewSeries();

  /// Another drive begins, perhaps of another vehicle: nothing is held any more.
  void startNewDrive();

  /// The estimates begin anew with the next row to be worth something, since the model has changed.
  void restartValidity() { rows_ = 0.0; }

  /// From the next row on; the estimates stay.
  /// @param options  of which memory, fastest_memory and forgetting_factor count.
  /// @throws std::invalid_argument  as RecursiveOptions::validate().
  void setForgetting(const MonitorSettings& options);

  /// @param stddevs  of (b1 [1/s], b0 [1/s^2]) by what the samples went through before: no row shows that.
  void setInputStddevs(const Eigen::Vector2d& stddevs) { input_stddevs_ = stddevs; }

  /// @param stddevs  of the errors of the stamps by which samples were brought onto the grid, of the sprung and the
  /// unsprung sensor [s].
  void setStampErrors(const Eigen::Vector2d& stddevs) { stamp_noise_.setStamps(stddevs); }

  /// @return the factor that rows are forgotten by now.
  double forgettingFactor() const { return least_absolute_.forgettingFactor(); }

  /// @return c_j of LA [unit of the effect's coefficient].
  double coefficient(std::size_t j) const {
    return least_absolute_.parameters()[kNumStrutParameters + static_cast<Eigen::Index>(j)];
  }

 private:
  /// How rows are forgotten.
  struct Forgetting {
    bool only_excited;                           // parameters of which the rows tell nothing are held
    std::optional<VariableForgetting> variable;  // none: by one factor always
    double fewest_rows = 0.0;                    // of a valid estimate
  };

  /// Both estimates as they were at the end of a block of rows (Excitation).
  struct Past {
    RecursiveEstimator::Past ls, la;
  };

  /// What a skew of the clocks does to the rows of the memory: tau x is in psi, x = b1 I_2^2 w'' + b0 I_1^2 w''.
  /// Means of x phi_1, x phi_0, and of the skew taken off.
  enum SkewEffect : std::size_t { kOnDamping, kOnStiffness, kTakenOff, kNumSkewEffects };

  Past present() const { return {least_squares_.present(), least_absolute_.present()}; }
  double withoutEffects(const RegressionRow& row) const;
  void update(const RegressionRow& row);
  void noteSkew(const RegressionRow& row);
  void closeBlock();
  void takeExcitation();
  bool isHeld(StrutParameter i) const { return forgetting_.only_excited && !excitation_.excited(i); }
  void forgetBy(double factor);
  void describeStddevs(StrutEstimate& ls, StrutEstimate& la);
  double fittedNoise(const Eigen::Vector2d& strut, double left) const;
  void removeShift(const Eigen::Vector2d& moment);
  double explainedBesideNoise(const StrutEstimate& estimate) const;
  double skewShift(int i) const;

  /// @return how many columns are those of the strut and of its effects: all but the sensors', which are the last.
  int numModelColumns() const { return least_absolute_.numParameters() - count(sensors_); }

  IntegralFilterOptions filter_;
  SensorColumns sensors_;
  Excitation excitation_;
  SynchronousRegression regression_;
  RecursiveLeastSquares least_squares_;
  RecursiveLeastAbsolute least_absolute_;
  Forgetting forgetting_;
  std::array<Past, 2> past_;  // at the ends of the newest two blocks that may have told something, the older one first
  Eigen::Vector2d input_stddevs_ = Eigen::Vector2d::Zero();
  StampNoise stamp_noise_;
  Eigen::VectorXd noise_shift_;  // of the parameters by the sensors' noise; 0 if it is left in them
  EveryN stddevs_due_;
  bool has_row_ = false;
  RunningMeans<kNumSkewEffects> skew_effect_;
  double rows_ = 0.0;                      // of the model's present columns
  double rows_to_forget_ = 0.0;            // until what a force from outside did is forgotten
  double lost_memories_ = 0.0;             // that LS has explained far more than LA for
  std::optional<NoiseLevel> noise_level_;  // none: what the noise shifts is left in the estimates
  double noise_share_ = 0.0;               // of the residuals' variance
  SilentRows silent_rows_;
  bool la_is_valid_ = false;
  bool hears_noise_ = false;  // in what LA leaves
};

}  // namespace suspension_health_monitor
