#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/every_n.h"
#include "suspension_health_monitor/internal/identification/level_changes.h"
#include "suspension_health_monitor/internal/identification/noise_level.h"
#include "suspension_health_monitor/internal/identification/paired_estimators.h"
#include "suspension_health_monitor/internal/identification/regressor_noise.h"
#include "suspension_health_monitor/internal/identification/resampling_noise.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/identification/skew_profile.h"
#include "suspension_health_monitor/internal/identification/wheel_history.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// What the estimates of a strut are off by beyond the scatter of rows, and their standard deviations with it: by noise
/// of the sensors in the regressors (RegressorNoise), whose shift is taken off once it is known; by what the wheel's
/// readings may have beyond that which the body does not answer; by what resampled readings are wrong by
/// (ResamplingNoise); by levels that change (LevelChanges); by the skew of the clocks (SkewProfile); by what the
/// samples went through before. These add up as squares (doc/uncertainty.md).
///
/// All but the last two put a moment E[phi e] into the rows, which R^-1 turns into a shift of the estimates. It is that
/// of LS for both: of normal residuals LA has the same. Cost per row: O(1), and O(p^2) every few rows for p columns; no
/// allocation.
class ErrorBudget {
 public:
  /// @param noise  of the same filter.  @param num_columns  of the regression.
  /// @param forgetting_factor  of the estimators.
  /// @param removes_noise_shift  false: what the noise shifts is left in the estimates.
  ErrorBudget(const IntegralFilterOptions& filter, const RegressorNoise& noise, int num_columns,
              double forgetting_factor, bool removes_noise_shift);

  /// @param columns  where those of the estimators come from now. Allocates.
  void changeColumns(const std::vector<ColumnOrigin>& columns);

  /// Takes in the next sample of an uninterrupted series.
  /// @param is_row  the estimators take in the rows about it, too; else only what is needed to go on.
  void addSample(const CornerSample& sample, bool is_row) { resampling_noise_.add(sample, is_row); }

  /// Takes in what a skew of the clocks does to a row that the estimators are about to take in.
  /// @param skew  by which the wheel's readings were moved [s].
  void addSkew(const RegressionRow& row, const WheelRow& wheel, double skew, const RecursiveEstimator& estimator);

  /// Takes in such a row once the estimators have.
  /// @param innovation  of LA by it, in the unit of psi.
  void addRow(const RegressionRow& row, double innovation, const RecursiveEstimator& estimator);

  /// The next sample does not follow the one before.
  void interrupt();

  /// Noise is heard in what a valid estimate leaves; to be called for every row.
  void noteValidity(const StrutEstimate& la);

  void setForgettingFactor(double forgetting_factor);

  /// As StrutIdentifier::setInputStddevs().
  void setInputStddevs(const Eigen::Vector2d& stddevs) { input_stddevs_ = stddevs; }

  /// As StrutIdentifier::setResamplingErrors().
  void setResamplingErrors(const ResamplingErrors& errors) { resampling_noise_.setErrors(errors); }

  /// @param folded  rms of what the wheel's sensor may have folded back, at most [m/s^2]: counts until noise has been
  /// heard.  @param at_limit  rms of white noise as dense as its readings are at half the rate [m/s^2]: over a long
  /// time they have no more of it, be it their sensor's or folded back.
  void setWheelSpectrum(double folded, double at_limit) { wheel_ = {folded, at_limit}; }

  /// @return what is to be taken off the parameters of LS and LA, one per column; 0 if it is left in them.
  const Eigen::VectorXd& noiseShift() const { return noise_shift_; }

  /// @return variance of the noise of a sensor [(m/s^2)^2]; 0 before that is known.
  double noiseVariance() const { return noise_variance_; }

  /// @return variances of what readings may be wrong by beyond the sensors' noise, at most, of the sprung and the
  /// unsprung sensor [(m/s^2)^2].
  const Eigen::Vector2d& wrongVariances() const { return wrong_.variances; }

  /// @return by how much that may have shifted a parameter, as a share of what it is then, of the one that it has
  /// shifted most; infinity: there is no telling.
  double wrongShare() const { return wrong_.share; }

  /// @return true if most of that is by a level of the readings that changes.
  bool isWrongByLevel() const { return wrong_.is_of_level; }

  /// Writes the standard deviations, every few rows, and says what noiseShift() is from then on. What is known of a
  /// parameter that is held does not change.
  /// @param skew  none: clocks are taken at their word.
  /// @param ls, la  as the estimators have them, with the noise's shift taken off.
  void describe(const PairedEstimators& estimators, const SkewProfile* skew, StrutEstimate& ls, StrutEstimate& la);

  /// One gyro tells the tops of a vehicle's struts with more noise than they may have of motion.
  /// @return StrutEstimate::explained of what is left of psi and of the residual without it [-]; of a single strut as
  /// it is.
  double explainedBesideNoise(const StrutEstimate& estimate) const;

 private:
  /// What a skew tau of the clocks does to the rows that a parameter's information is from: tau x is in psi,
  /// x = b1 I_2^2 w'' + b0 I_1^2 w''. Means of x phi_i, and of that times the skew that was taken off.
  enum SkewEffect : std::size_t { kOfSkew, kTakenOff, kNumSkewEffects };

  /// E[phi e] of a row by the sensors' noise, its standard deviation, and that of what readings may be wrong by
  /// beside it: none is as large as it may be.
  struct NoiseMoments {
    Eigen::Vector2d mean, spread;
    std::optional<Eigen::Vector2d> of_wrong_readings;
  };

  NoiseMoments takeNoise(const PairedEstimators& estimators, const Eigen::Vector2d& strut);
  double mostUnanswered(double slow, double noise, double by_chance, const Eigen::Vector2d& strut) const;
  std::optional<Eigen::Vector2d> wrongMoment(const RecursiveLeastSquares& least_squares,
                                             const Eigen::Vector2d& estimate);
  double unfittedNoise(const RecursiveLeastSquares& least_squares, const Eigen::Vector2d& strut, double left) const;
  void removeShift(const PairedEstimators& estimators, const Eigen::Vector2d& moment);
  double skewShift(const RecursiveLeastSquares& least_squares, const SkewProfile* skew, int i) const;

  RegressorNoise noise_;
  double block_;                           // as NoiseLevel::blockRows()
  std::optional<NoiseLevel> noise_level_;  // none: what the noise shifts is left in the estimates
  bool hears_noise_ = false;               // in what LA leaves
  double noise_variance_ = 0.0;            // of a sensor, over the time that it has been heard for
  double noise_share_ = 0.0;               // of the residuals' variance
  Eigen::VectorXd noise_shift_;            // of the parameters
  ResamplingNoise resampling_noise_;
  LevelChanges level_changes_;
  struct {
    Eigen::Vector2d variances = Eigen::Vector2d::Zero();
    double share = 0.0;
    bool is_of_level = false;
  } wrong_;  // as wrongVariances(), wrongShare(), isWrongByLevel()
  struct {
    double folded = 0.0, at_limit = 0.0;
  } wheel_;  // as of setWheelSpectrum()
  std::array<RunningMeans<kNumSkewEffects>, kNumStrutParameters> skew_effects_;
  Eigen::Vector2d input_stddevs_ = Eigen::Vector2d::Zero();
  EveryN stddevs_due_;
};

}  // namespace suspension_health_monitor
