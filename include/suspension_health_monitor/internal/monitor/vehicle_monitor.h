#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/vehicle/decoupler.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

namespace suspension_health_monitor {

/// Watches all struts of a vehicle, one SuspensionMonitor for each.
///
/// reading -> VehicleBlocks: estimates of every strut at its own top, and the rows of all tops
/// sample -> Decoupler: what the other struts do, by these rows, is taken out -> SuspensionMonitor::addGridSample: LS,
/// LA, free run and models with effects.
/// Until the rows are known there is no monitor: what a strut seems to be is mostly its neighbours then. Once known
/// they stay; rows that say less change nothing. Where integration_horizon is left out a strut gets the one that suits
/// its row. One strut alone, without known forces, has nothing to be taken off, and is a SuspensionMonitor. Cost per
/// reading: as VehicleBlocks; per sample O(N^2); no lock.
class VehicleMonitor {
 public:
  /// @param strut  its place.
  using Sink = std::function<void(std::size_t strut, const MonitorReport& report)>;

  /// @param settings  by strut; sample_period is that of the first. Without it begin() has to come before the rest.
  /// @param sink  called with the report of every strut after every sample that gave one.
  /// @param num_forces  known forces in every sample.
  /// @throws std::invalid_argument  as SuspensionMonitor; without a strut, or with more than kMostStruts.
  VehicleMonitor(const std::vector<MonitorSettings>& settings, Sink sink, int num_forces = 0);

  /// @param period  sampling time of all struts [s].
  /// @throws std::invalid_argument  likewise.
  void begin(double period);

  /// Takes in one reading of one sensor on its own stamp.
  /// @param vehicle  that of the first reading counts.
  void addReading(const VehicleChannels& vehicle, const VehicleReading& reading);

  /// Takes in the next sample of the grid; gaps and clocks that go back begin a new series.
  void addGridSample(const VehicleSample& sample);

  /// The readings of all IMUs at the tops and wheels at one instant, then the sample: for sensors that are in step.
  void addSample(const VehicleSample& sample);

  /// As SuspensionMonitor has them; what is set before there is one waits for it.
  void setEffects(std::size_t strut, const std::vector<ActiveEffect>& effects,
                  const std::optional<LinearStrut>& start = {});
  /// @throws std::invalid_argument  if a value of it is not above 0 and finite.
  void setBaseline(std::size_t strut, const Baseline& baseline);
  /// @return what health is judged by, or will be; empty as long as nothing was given or learned.
  Baseline baseline(std::size_t strut) const;
  void reconfigure(std::size_t strut, MonitorSettings settings);

  /// As SuspensionMonitor; it is lost while there is no monitor.
  void addTemperature(std::size_t strut, Stamp stamp, double celsius);

  /// @param imu  of a strut; of others nothing is done.  @param up  as SensorReport::up.
  void setUp(const VehicleStreams::Sensor& imu, std::string_view up);

  /// Tests the vehicle file (VehicleClaims) and fits a rigid body to the rows (fitRigidBody), so that absolute values
  /// carry the model's error. Takes 10 ms for four struts: not for the sample path.
  void fitBody();

  /// The same: at once for the first time, and then, where enough blocks are new, one portion a call: at most 2 ms.
  void fitBodyIfDue();

  /// @return nullptr while the rows are not known.
  const SuspensionMonitor* strut(std::size_t i) const { return struts_.empty() ? nullptr : &struts_[i]; }
  std::size_t numStruts() const { return starts_.size(); }
  const MonitorSettings& settings() const { return starts_.front().settings; }  ///< of the first strut

  /// @return true once the rows are known.
  bool isCoupled() const { return !struts_.empty(); }

  /// @return the rows that the struts are taken apart with; nullptr while they are not known, and of a strut alone.
  const BodyRows* rows() const { return decoupler_ ? &rows_ : nullptr; }

  /// @return what fitBody() found last.
  const std::optional<BodyFitResult>& body() const { return body_; }
  const VehicleChannels* vehicle() const { return blocks_ ? &blocks_->vehicle() : nullptr; }

  /// @return what fitBody() found last against the vehicle file; of one strut there is nothing.
  const VehicleMistake& mistake() const { return mistake_; }

  /// @return the estimate over all readings so far, as SuspensionMonitor::overTheDrive(). Not for the sample path.
  StrutEstimate overTheDrive(std::size_t strut);

 private:
  /// What a strut is to be begun with.
  struct Start {
    explicit Start(const MonitorSettings& its) : settings(its) {}

    MonitorSettings settings;
    std::vector<ActiveEffect> effects;
    std::optional<LinearStrut> strut;  // that belongs to the effects
    std::optional<Baseline> baseline;
  };

  void learnRows();
  void fitRows();
  void beginStruts();
  void takeModels();
  void takeDeadGyro();
  std::optional<Measured> sharedByOthers(std::size_t strut) const;
  Eigen::Vector2d modelStddev(const TopEstimate& estimate) const;

  Stamp period_{};  // 0 until it is known
  Sink sink_;
  std::vector<Start> starts_;  // by strut
  int num_forces_;
  std::optional<VehicleBlocks> blocks_;  // from the first reading on
  BodyRows rows_, newest_rows_;
  std::optional<BodyFitResult> body_;
  std::optional<VehicleClaims> claims_;  // while they are worked through
  VehicleMistake mistake_{VehicleMistake::Kind::kTooLittle, {}};
  Eigen::ArrayXXd model_errors_;  // VehicleClaims::modelErrors()
  std::optional<Decoupler> decoupler_;
  std::vector<SuspensionMonitor> struts_;
  std::int64_t samples_ = 0;      // since the rows are known
  bool is_alone_;                 // nothing known moves the one strut
  std::optional<Stamp> last_;     // sample
  std::optional<Stamp> coupled_;  // first fit of the body when it was due
  Stamp fitted_{};                // the last one
};

}  // namespace suspension_health_monitor
