#include "suspension_health_monitor/strut_monitor.h"

#include <utility>

#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"

namespace suspension_health_monitor {

StrutMonitor::StrutMonitor(const MonitorOptions& options, Sink sink)
    : pipeline_(std::make_unique<VehiclePipeline>(options, std::move(sink))) {}

StrutMonitor::~StrutMonitor() = default;
StrutMonitor::StrutMonitor(StrutMonitor&& other) noexcept = default;
StrutMonitor& StrutMonitor::operator=(StrutMonitor&& other) noexcept = default;

void StrutMonitor::push(Side side, Stamp stamp, double acceleration) { pipeline_->push(side, stamp, acceleration); }

void StrutMonitor::setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut) {
  pipeline_->setEffects(effects, strut);
}

void StrutMonitor::setBaseline(const Baseline& baseline) { pipeline_->setBaseline(baseline); }

Baseline StrutMonitor::baseline() const { return pipeline_->baseline(); }

MonitorReport StrutMonitor::report() const {
  return pipeline_->strut() != nullptr ? pipeline_->strut()->report() : MonitorReport{};
}

std::optional<TyreReport> StrutMonitor::tyre() const {
  if (pipeline_->tyre() == nullptr) return std::nullopt;
  return pipeline_->tyre()->report();
}

InputStatus StrutMonitor::input() const {
  return pipeline_->strut() != nullptr ? pipeline_->strut()->input() : InputStatus{};
}

std::map<std::string, std::uint64_t> StrutMonitor::rejected() const { return pipeline_->rejected().byName(); }

std::optional<double> StrutMonitor::samplePeriod() const { return pipeline_->period(); }

}  // namespace suspension_health_monitor
