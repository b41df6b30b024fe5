#include "suspension_health_monitor/internal/monitor/strut_pipeline.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "suspension_health_monitor/internal/plain_text.h"

namespace suspension_health_monitor {
namespace {

void requirePositive(const char* name, const std::optional<double>& value) {
  if (value && !(*value > 0.0 && std::isfinite(*value)))
    throw std::invalid_argument("baseline " + std::string(name) + " = " + numberText(*value) +
                                ", must be above 0 and finite");
}

}  // namespace

StrutPipeline::StrutPipeline(const MonitorSettings& settings, Sinks sinks)
    : settings_(settings), sinks_(std::move(sinks)) {
  settings_.validate();
  if (settings_.sample_period) start(*settings_.sample_period);
}

void StrutPipeline::start(double period) {
  settings_.sample_period = period;
  monitor_.emplace(settings_);
  grid_.emplace(period, settings_.grid(period));
  if (settings_.tyre) tyre_.emplace(settings_);
  if (baseline_) monitor_->setBaseline(*baseline_);
  if (!effects_.empty()) monitor_->setEffects(effects_, strut_);
}

void StrutPipeline::setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut) {
  requireUsable(effects);
  if (monitor_) return monitor_->setEffects(effects, strut);
  effects_ = effects;
  strut_ = strut;
}

void StrutPipeline::setBaseline(const Baseline& baseline) {
  requirePositive("damping_to_mass", baseline.damping_to_mass);
  requirePositive("stiffness_to_mass", baseline.stiffness_to_mass);
  if (monitor_)
    monitor_->setBaseline(baseline);
  else
    baseline_ = baseline;
}

void StrutPipeline::reconfigure(const MonitorSettings& settings) {
  MonitorSettings changed = settings;
  changed.sample_period = settings_.sample_period;
  if (monitor_) monitor_->reconfigure(changed);
  if (tyre_) tyre_->reconfigure(changed);
  settings_ = changed;
}

void StrutPipeline::push(Side side, Stamp stamp, double acceleration) {
  if (is_refused_) return;
  if (!monitor_) {
    const std::optional<double> period = early_.add({indexOf(side), stamp, acceleration});
    if (!period) return;
    startOnce(*period);
    replayEarly();
  } else if (early_.isEmpty()) {
    take(side, stamp, acceleration);
  } else {  // a sink has thrown while they were replayed
    early_.append({indexOf(side), stamp, acceleration});
    replayEarly();
  }
}

// Settings that do not fit what was measured will not fit it at the next reading either: that is said once.
void StrutPipeline::startOnce(double period) {
  try {
    start(period);
  } catch (const std::invalid_argument&) {
    is_refused_ = true;
    monitor_.reset();
    throw;
  }
}

// A sink may throw; readings that come after those that it has seen wait for the next push().
void StrutPipeline::replayEarly() {
  while (const auto reading = early_.next()) take(static_cast<Side>(reading->stream), reading->stamp, reading->value);
}

void StrutPipeline::take(Side side, Stamp stamp, double acceleration) {
  auto sample = grid_->push(side, stamp, acceleration);
  if (const std::optional<Stamp> taken = grid_->streams().taken(); taken && side != Side::kRoad)
    monitor_->addReading(side, *taken, acceleration);
  for (; sample; sample = grid_->next()) {
    if (tyre_) {
      tyre_->setPeriodFits(monitor_->input().period_fits);
      tyre_->add(*sample, grid_->roadAcceleration());
    }
    const MonitorReport* report = monitor_->addGridSample(*sample);
    if (sinks_.sample) sinks_.sample(*sample);
    if (report != nullptr && sinks_.report) sinks_.report(*report);
  }
}

RejectCounts StrutPipeline::rejected() const {
  RejectCounts all = early_.rejected();
  if (grid_) all += grid_->streams().rejected();
  if (monitor_) all += monitor_->rejected();
  return all;
}

}  // namespace suspension_health_monitor
