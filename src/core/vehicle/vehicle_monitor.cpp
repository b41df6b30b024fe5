#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/signal/continuity.h"
#include "suspension_health_monitor/internal/vehicle/sensor_noise.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"

namespace suspension_health_monitor {
namespace {

constexpr double kCouplingMemory = 60.0;  // [s]: a body and where its struts stand change with the load at most
constexpr double kCouplingEvery = 1.0;    // [s]
constexpr double kModelsEvery = 0.1;      // [s]

Stamp periodOf(const std::vector<MonitorSettings>& settings) {
  requireNumStruts(settings.size());
  for (const MonitorSettings& each : settings) {
    if (!each.sample_period) throw std::invalid_argument("sample_period is not given, must be above 0 [s]");
    if (*each.sample_period != *settings.front().sample_period)
      throw std::invalid_argument("sample_period differs between struts, must be the same for all of a vehicle");
    each.validate();
  }
  return fromSeconds(*settings.front().sample_period);
}

int samplesOf(double seconds, double period) { return std::max(1, static_cast<int>(std::lround(seconds / period))); }

}  // namespace

VehicleMonitor::VehicleMonitor(const std::vector<MonitorSettings>& settings, Sink sink, int num_forces,
                               const SensorNoise& noise)
    : period_(periodOf(settings)),
      sink_(std::move(sink)),
      noise_(knownNoise(noise, settings.size())),
      survey_({static_cast<int>(settings.size()), num_forces}, toSeconds(period_), kCouplingMemory, noise_),
      coupling_due_(samplesOf(kCouplingEvery, toSeconds(period_))),
      models_due_(samplesOf(kModelsEvery, toSeconds(period_))),
      is_alone_(settings.size() == 1 && num_forces == 0) {
  for (const MonitorSettings& each : settings) starts_.push_back({each, {}, {}, {}});
  if (!is_alone_) return;
  coupling_ = survey_.estimate();
  coupling_->stddevs.setZero();
  coupling_->condition = 1.0;
  beginStruts();
}

void VehicleMonitor::setNoise(const SensorNoise& noise) {
  noise_ = noise;
  survey_.setNoise(noise);
}

void VehicleMonitor::beginStruts() {
  for (const Start& start : starts_) {
    SuspensionMonitor& strut = struts_.emplace_back(start.settings);
    if (!start.effects.empty()) strut.setEffects(start.effects, start.strut);
    if (start.baseline) strut.setBaseline(*start.baseline);
  }
}

void VehicleMonitor::setEffects(std::size_t strut, const std::vector<ActiveEffect>& effects,
                                const std::optional<LinearStrut>& start) {
  if (isCoupled()) return struts_[strut].setEffects(effects, start);
  requireUsable(effects);
  starts_[strut].effects = effects;
  starts_[strut].strut = start;
}

void VehicleMonitor::setBaseline(std::size_t strut, const Baseline& baseline) {
  if (isCoupled()) return struts_[strut].setBaseline(baseline);
  starts_[strut].baseline = baseline;
}

void VehicleMonitor::addSample(const VehicleSample& sample) {
  const Continuity how = last_ ? continuity(sample.stamp - *last_, period_) : Continuity::kGap;
  if (how == Continuity::kTooSoon) return;
  last_ = sample.stamp;
  if (how != Continuity::kContinues) startNewSeries();
  const VehicleSample* own = &sample;
  if (!is_alone_) {
    survey_.add(sample);
    if (coupling_due_()) learnCoupling();
    if (!decoupler_) return;
    if (models_due_()) takeModels();
    own = decoupler_->push(sample);
    if (own == nullptr) return;
  }
  for (std::size_t i = 0; i < struts_.size(); ++i) {
    const MonitorReport* report = struts_[i].addSample(own->ofStrut(i));
    if (report != nullptr && sink_) sink_(i, *report);
  }
}

// The grid has heard the body's IMU for seconds when it gives the first sample.
void VehicleMonitor::addSample(const VehicleGrid& grid, const VehicleSample& sample) {
  if (!last_ && grid.needsBodyImu()) setNoise(grid.noise());
  addSample(sample);
}

void VehicleMonitor::learnCoupling() {
  const CouplingEstimate& estimate = survey_.solve();
  if (!estimate.isKnown()) return;
  if (!decoupler_) begin(estimate);
  decoupler_->setCoupling(estimate.coupling);
  coupling_ = estimate;
}

void VehicleMonitor::begin(const CouplingEstimate& estimate) {
  const std::vector<StrutModel> models = estimate.models();
  decoupler_.emplace(toSeconds(period_), estimate.coupling, models);
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    MonitorSettings& settings = starts_[i].settings;
    if (!settings.integration_horizon)
      settings.integration_horizon = proposeHorizon(models[i].damping_to_mass, models[i].stiffness_to_mass).horizon;
  }
  beginStruts();
}

// As long as a strut has no valid estimate it shows in others as the coupling was learned with it.
void VehicleMonitor::takeModels() {
  for (std::size_t i = 0; i < struts_.size(); ++i) {
    const StrutEstimate& now = struts_[i].report().estimate;
    if (now.valid()) decoupler_->setModel(i, {now.damping_to_mass, now.stiffness_to_mass, struts_[i].effects(), {}});
  }
}

void VehicleMonitor::startNewSeries() {
  survey_.startNewSeries();
  if (decoupler_) decoupler_->startNewSeries();
}

}  // namespace suspension_health_monitor
