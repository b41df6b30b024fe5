#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/every_n.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/vehicle/coupling_survey.h"
#include "suspension_health_monitor/internal/vehicle/decoupler.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

namespace suspension_health_monitor {

/// Watches all struts of a vehicle: samples of all sensors in, one SuspensionMonitor per strut.
///
/// sample -> CouplingSurvey: how the struts move one another
///        -> Decoupler: every strut on its own -> SuspensionMonitor::addSample of each.
/// Until the coupling is known there is no monitor: what a strut seems to be is mostly its neighbours then. Once known
/// it stays; rows that tell less change nothing. Where integration_horizon is left out a strut gets the one that suits
/// what the coupling knows of it. One strut alone, without known forces, has nothing to be taken off, and is a
/// SuspensionMonitor.
/// Cost per sample: O(N^2) and once a second O(N^3); no lock.
class VehicleMonitor {
 public:
  /// @param strut  its place.
  using Sink = std::function<void(std::size_t strut, const MonitorReport& report)>;

  /// @param settings  of each strut, with sample_period given, the same in all.
  /// @param sink  called with the report of every strut after every sample that gave one.
  /// @param num_forces  known forces in every sample.
  /// @param noise  what that of the sensors makes of the samples, as in VehicleDrive.
  /// @throws std::invalid_argument  as SuspensionMonitor; without a strut, or with more than kMostStruts.
  VehicleMonitor(const std::vector<MonitorSettings>& settings, Sink sink, int num_forces = 0,
                 const SensorNoise& noise = {});

  /// As more is known of the noise. Allocates.
  void setNoise(const SensorNoise& noise);

  /// Takes in the next sample; gaps and clocks that go back begin a new series.
  void addSample(const VehicleSample& sample);

  /// The same of a grid, with what this knows of its sensors: noise, by the first sample, and errors of the stamps.
  void addSample(const VehicleGrid& grid, const VehicleSample& sample);

  /// As SuspensionMonitor has them; what is set before there is a monitor waits for it.
  void setEffects(std::size_t strut, const std::vector<ActiveEffect>& effects,
                  const std::optional<LinearStrut>& start = {});
  void setBaseline(std::size_t strut, const Baseline& baseline);

  /// @return nullptr while the coupling is not known.
  const SuspensionMonitor* strut(std::size_t i) const { return struts_.empty() ? nullptr : &struts_[i]; }
  std::size_t numStruts() const { return starts_.size(); }

  /// @return true once the coupling is known.
  bool isCoupled() const { return !struts_.empty(); }

  /// @return the coupling that the struts are taken apart with; nullptr while it is not known.
  const CouplingEstimate* coupling() const { return coupling_ ? &*coupling_ : nullptr; }

  /// @return what the rows of late say of the coupling.
  const CouplingEstimate& estimate() const { return survey_.estimate(); }

 private:
  /// What a strut is to be begun with.
  struct Start {
    MonitorSettings settings;
    std::vector<ActiveEffect> effects;
    std::optional<LinearStrut> strut;
    std::optional<Baseline> baseline;
  };

  void startNewSeries();
  void learnCoupling();
  void begin(const CouplingEstimate& estimate);
  void beginStruts();
  void takeModels();

  Stamp period_;
  Sink sink_;
  std::vector<Start> starts_;  // by strut
  SensorNoise noise_;          // until there are struts
  CouplingSurvey survey_;
  std::optional<CouplingEstimate> coupling_;
  std::optional<Decoupler> decoupler_;
  std::vector<SuspensionMonitor> struts_;
  EveryN coupling_due_, models_due_;
  bool is_alone_;  // nothing known moves the one strut
  std::optional<Stamp> last_;
};

}  // namespace suspension_health_monitor
