#pragma once

#include <boost/circular_buffer.hpp>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/health/assessment.h"
#include "suspension_health_monitor/internal/health/sensor_check.h"
#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/monitor/model_tracker.h"
#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {

/// Identifies one strut from a series of samples: the facade that the nodelet, the command line and the tests share.
///
/// Per reading: the blocks of both sensors (VehicleBlocks), whose estimate comes after every half block. Per sample of
/// the grid, as in the paper: integral filter (9) -> regression row (28)-(30) -> LS (15)-(17) and LA (24)-(26), then
/// the free run against the measurement. Health is judged with every block estimate. While samples come at another
/// period than that of the options no estimate is valid (InputStatus::period_fits). With effects in the model
/// (ModelTracker) the plain one runs along, with LS and LA of its own, to be compared with. Cost per sample: O(1)
/// whatever the horizon; no allocation, no lock.
class SuspensionMonitor {
 public:
  /// @param options  with sample_period given.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  /// @param has_own_blocks  false: a vehicle gives the plain model its block estimates, by takeEstimate().
  explicit SuspensionMonitor(const MonitorSettings& options, bool has_own_blocks = true);

  /// Has these effects in the model from now on; none: the plain model. Estimates carry over, coefficients are start
  /// values, shapes stay as they are given. Not for the sample path: allocates.
  /// @param strut  b1 and b0 that belong to these coefficients, if they are known: those of the plain model stand for a
  /// part of the effects.
  /// @throws std::invalid_argument  naming what is wrong with the effects; the model then stays as it was.
  void setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut = {});

  /// @return the effects in the model, with the coefficients that the free run has now.
  const std::vector<ActiveEffect>& effects() const { return tracker().effects(); }

  /// Goes on with other forgetting factors and other thresholds of health; estimates and filters are kept.
  /// @param options  which differ from options() in nothing else.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed; all then stays as it was.
  void reconfigure(const MonitorSettings& options);

  /// Takes in one reading of one sensor on its own stamp, for the block estimate. Stamps of a sensor increase.
  void addReading(Side side, Stamp stamp, double acceleration);

  /// Takes the block estimate of the plain model from elsewhere.  @param model_stddev  as ModelTracker::takeEstimate().
  void takeEstimate(const TopEstimate& estimate, const Eigen::Vector2d& model_stddev);

  /// Takes in the temperature of the strut's damper [deg C], which is used until it is older than health/oldest_data.
  void addTemperature(Stamp stamp, double celsius);

  /// What gravity says points up on an IMU, as SensorReport::up.
  void setUp(Side side, std::string_view up) { sensors_.setUp(side, up); }

  /// As HealthAssessment::setOthers(), dampingChange().
  void setOthers(const std::optional<Measured>& others) { health_.setOthers(others); }
  const std::optional<Measured>& dampingChange() const { return health_.dampingChange(); }

  /// While the newest blocks of elsewhere say nothing of the strut LS and LA stay as they are.
  void hold(bool holds) { plain_.hold(holds); }

  /// Both readings of an instant, then the sample: for sensors that are in step.
  const MonitorReport* addSample(const CornerSample& sample) {
    addReading(Side::kSprung, sample.stamp, sample.sprung_acceleration);
    addReading(Side::kUnsprung, sample.stamp, sample.unsprung_acceleration);
    return addGridSample(sample);
  }

  /// Takes in the next sample. A gap or a clock that goes back empties the filter (no rows follow until it is full);
  /// estimates hold meanwhile, marked as not valid.
  /// @return the report, owned by this object and valid until the next call; nullptr if the sample was rejected, and,
  ///         with effects in the model, for the first FreeRun::kDelay samples of a series and after setEffects(): its
  ///         reports are so late, and no stamp is reported twice.
  const MonitorReport* addGridSample(const CornerSample& sample);

  /// Judges health by this from now on.
  void setBaseline(const Baseline& baseline) { health_.setBaseline(baseline); }
  const Baseline& baseline() const { return health_.baseline(); }

  /// @return as ModelTracker::overTheDrive(), of the model with effects if there is one.
  StrutEstimate overTheDrive() { return (extended_ ? *extended_ : plain_).overTheDrive(); }
  /// @param plain  what the blocks of elsewhere say of the plain model.  @param model_stddev  as takeEstimate().
  StrutEstimate overTheDrive(const std::optional<TopEstimate>& plain, const Eigen::Vector2d& model_stddev) {
    return extended_ ? extended_->overTheDrive() : plain_.judged(plain, model_stddev);
  }

  /// @return what models are made of: the block estimate, or, with `preset: paper`, LA.
  const StrutEstimate& modelEstimate() const { return options_.preset == "paper" ? report_.la : report_.estimate; }

  const MonitorReport& report() const { return report_; }
  const InputStatus& input() const { return input_; }
  const RejectCounts& rejected() const { return rejected_; }
  const MonitorSettings& options() const { return options_; }
  /// @return lambda of LS and LA.
  double forgettingFactor() const { return tracker().forgettingFactor(); }
  double period() const { return toSeconds(period_); }
  int horizonSamples() const { return horizon_samples_; }

 private:
  std::optional<Continuity> follow(const CornerSample& sample);
  const CornerSample* track(const CornerSample& sample);
  void judgeSensors();
  template <class Change>
  void changeModels(const Change& change);
  const ModelTracker& tracker() const { return extended_ ? *extended_ : plain_; }

  MonitorSettings options_;
  int horizon_samples_;
  Stamp period_;
  std::optional<Stamp> first_, last_;                                 // samples of the drive
  boost::circular_buffer<CornerSample> recent_{FreeRun::kDelay + 1};  // of the uninterrupted series
  RunningMean spacing_;                                               // of uninterrupted samples [s]
  InputStatus input_;
  RejectCounts rejected_;
  ModelTracker plain_;
  std::optional<ModelTracker> extended_;  // with effects
  ModelReport base_;                      // of the plain model while there is an extended one
  HealthAssessment health_;
  SensorCheck sensors_;
  std::optional<std::pair<Stamp, double>> temperature_;  // the newest of the damper [deg C]
  std::uint64_t samples_ = 0;
  bool has_new_estimate_ = false;        // that health has not seen
  std::optional<Stamp> reported_until_;  // by the model before the effects were set
  MonitorReport report_;
};

}  // namespace suspension_health_monitor
