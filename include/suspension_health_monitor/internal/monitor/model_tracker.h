#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/monitor/strut_identifier.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// One model of the strut, plain or with effects, followed through a drive: the estimates of its blocks (VehicleBlocks)
/// and of its rows (StrutIdentifier), the decision whether they are valid (doubtOf()), and the free run against the
/// measurement: with the block estimate, or LA's where there is none, as with `preset: paper`.
///
/// Rows of the plain model are those of the newest sample. The columns of effects need travel and travel rate, which
/// the free run gives FreeRun::kDelay samples late: the rows of a model with effects are as late.
/// Cost per sample: O(1) whatever the horizon; no allocation.
class ModelTracker {
 public:
  /// The plain model.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  /// @param has_own_blocks  false: a vehicle gives it its block estimates, by takeEstimate().
  explicit ModelTracker(const MonitorSettings& options, bool has_own_blocks = true);

  /// Goes on with other effects: estimates and covariance of b1, b0 and of the effects that stay (same name and shapes)
  /// carry over, as does the free run. Coefficients of the others are start values. The estimates are valid again after
  /// enough rows of the new model.
  /// @param strut  b1 and b0 that belong to the start values; the free run goes on with them until there are estimates.
  /// @throws std::invalid_argument  as FreeRun::setEffects().
  void setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut,
                  ModelReport& report);

  const std::vector<ActiveEffect>& effects() const { return free_run_.model().effects; }

  /// Takes in one reading of one sensor, on its own stamp, for the blocks.
  /// @return true if it brought a new block estimate.
  bool addReading(Side side, Stamp stamp, double acceleration, ModelReport& report);

  /// Takes the blocks' estimate from elsewhere, with the model's error in b1 [1/s] and b0 [1/s^2].
  void takeEstimate(const TopEstimate& estimate, const Eigen::Vector2d& model_stddev, ModelReport& report);

  /// While the newest blocks say nothing of the strut LS and LA stay as they are.
  void hold(bool holds) { identifier_.hold(holds); }

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @param time  of the newest sample since the start of the drive [s]; of no effect on the plain model.
  /// @param compared  the sample FreeRun::kDelay before the newest; nullptr: the series is too short yet.
  /// @return true if it brought a new block estimate (only with effects: their forces complete blocks here).
  bool add(const CornerSample& newest, double time, const CornerSample* compared, ModelReport& report);

  /// Of a model with effects, as long as it has no valid estimate of its own: sets b1, b0 of the free run, with the
  /// effects' start values.
  void lead(const StrutEstimate& plain);

  void startNewSeries(ModelReport& report);

  /// Another drive begins, perhaps of another vehicle: nothing is held any more.
  void startNewDrive(ModelReport& report);

  /// @param input  from now on nothing is valid while a sensor reads in another unit, and LS and LA are not while
  /// samples come at another period than that of the options.
  /// @param now  that the age of the estimate counts to.
  void setInput(const InputStatus& input, Stamp now, ModelReport& report);

  /// As StrutIdentifier::setForgetting(), and health/oldest_data.
  void setOptions(const MonitorSettings& options);

  /// @return true while what is measured tells nothing of the strut, and LS and LA stay as they are.
  bool holds() const { return identifier_.holds(); }

  /// @return the block estimate with its doubt.  @param model_stddev  as takeEstimate().
  StrutEstimate judged(const std::optional<TopEstimate>& blocks, const Eigen::Vector2d& model_stddev) const;

  /// @return the estimate over all readings so far, as VehicleBlocks::overTheDrive(); with NaN: too little is known.
  /// Not for the sample path.
  StrutEstimate overTheDrive() { return judged(blocks_->overTheDrive(), Eigen::Vector2d::Zero()); }

  /// @return the factor that rows are forgotten by.
  double forgettingFactor() const { return identifier_.forgettingFactor(); }

 private:
  bool take(const TopEstimate* estimate, ModelReport& report);
  bool addRow(const CornerSample& sample, ModelReport& report);
  void judge(ModelReport& report);
  EstimateFacts factsOf(const StrutEstimate& estimate, bool has_estimate) const;
  void takeModel(const ModelReport& report);
  void fallBack();
  void compare(const CornerSample& sample, const std::optional<double>& predicted, ModelReport& report);

  bool is_paper_;
  double block_length_, period_, oldest_data_;  // [s]
  std::optional<VehicleBlocks> blocks_;
  /// Of the newest block estimate.
  struct Newest {
    Stamp stamp{};
    double age = 0.0;
  };
  std::optional<Newest> newest_;
  StrutIdentifier identifier_;
  Stamp now_{};
  EstimateFacts of_input_;  // what concerns no estimator
  FreeRun free_run_;
  std::vector<double> starts_;  // of the coefficients
  bool is_given_ = false;       // b1 and b0 came with the effects
  bool has_own_model_ = false;  // the free run has had estimated parameters, or those that belong to the start values
  std::uint64_t runaways_ = 0;
  std::uint64_t samples_ = 0, compared_ = 0;  // the model, and rmse and fit, are renewed every 8th
  RunningComparison comparison_;
  bool free_run_fails_ = false;
};

}  // namespace suspension_health_monitor
