#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/monitor/validity_gate.h"

namespace suspension_health_monitor {
namespace {

constexpr double kHorizonsOfSensorCheck = 17.0;  // of rows that an estimate needs before it may accuse a sensor
constexpr double kFewestUpdates = 25.0;  // of health, that readings are averaged over: of fewer nobody knows a mean

const MonitorSettings& checked(const MonitorSettings& options) {
  if (!options.sample_period) throw std::invalid_argument("sample_period is not given, must be above 0 [s]");
  options.validate();
  return options;
}

}  // namespace

SuspensionMonitor::SuspensionMonitor(const MonitorSettings& options)
    : options_(checked(options)),
      series_(fromSeconds(*options.sample_period)),
      plain_(options),
      health_(options.health(*options.sample_period)),
      sensors_(options.gravity_tolerance,
               std::max(options.comparison_window / *options.sample_period,
                        kFewestUpdates * health_.options().rows_per_update),
               health_.options().horizon_samples),
      health_due_(health_.options().rows_per_update) {}

// Of the plain model's tracker with its report, and of the extended one's.
template <class Change>
void SuspensionMonitor::changeModels(const Change& change) {
  change(plain_, extended_ ? base_ : report_);
  if (extended_) change(*extended_, report_);
}

void SuspensionMonitor::setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut) {
  if (effects.empty()) {
    if (extended_) static_cast<ModelReport&>(report_) = base_;
    extended_.reset();
    return;
  }
  ModelTracker next = tracker();
  ModelReport report = report_;
  next.setEffects(effects, strut, report);
  if (!extended_) {
    base_ = report_;
    reported_until_ = series_.newest();
  }
  static_cast<ModelReport&>(report_) = report;
  extended_.emplace(std::move(next));
}

void SuspensionMonitor::reconfigure(const MonitorSettings& options) {
  options_ = checked(options);
  health_.setOptions(options.health(period()));
  sensors_.setTolerance(options.gravity_tolerance);
  changeModels([&](ModelTracker& model, ModelReport&) { model.setForgetting(options); });
}

void SuspensionMonitor::setInputStddevs(const Eigen::Vector2d& stddevs) {
  changeModels([&](ModelTracker& model, ModelReport&) { model.setInputStddevs(stddevs); });
}

void SuspensionMonitor::setResamplingErrors(const ResamplingErrors& errors) {
  changeModels([&](ModelTracker& model, ModelReport&) { model.setResamplingErrors(errors); });
}

const MonitorReport* SuspensionMonitor::addSample(const CornerSample& sample) {
  const std::optional<Continuity> how = series_.add(sample);
  if (!how) return nullptr;
  if (*how != Continuity::kContinues) {
    reported_until_.reset();
    changeModels([&](ModelTracker& model, ModelReport& report) {
      *how == Continuity::kGap ? model.startNewSeries(report) : model.startNewDrive(report);
    });
  }
  const CornerSample* of_row = track(sample);
  if (of_row == nullptr || (reported_until_ && of_row->stamp <= *reported_until_)) return nullptr;
  report_.stamp = of_row->stamp;
  report_.measured = of_row->sprung_acceleration;
  sensors_.add(sample);
  if (health_due_()) judgeHealth();
  return &report_;
}

// Leads the sample through the models.
// @return the sample that the report is about; nullptr: none yet.
const CornerSample* SuspensionMonitor::track(const CornerSample& sample) {
  const CornerSample* compared = series_.delayed();
  plain_.add(sample, series_.time(), compared, extended_ ? base_ : report_);
  if (extended_) {
    extended_->lead(base_.la);
    extended_->add(sample, series_.time(), compared, report_);
    report_.comparison.base_rmse = base_.comparison.rmse;
    report_.comparison.base_fit_percent = base_.comparison.fit_percent;
  }
  if (report_.has_row) series_.countRow();
  return extended_ ? compared : &sample;
}

void SuspensionMonitor::judgeHealth() {
  series_.noteBeyondStrut(sensors_.bodyBeyondStrut(), sensors_.bodyBeyondStrutLevel());
  series_.judge();
  changeModels([&](ModelTracker& model, ModelReport& report) { model.setInput(input(), report); });
  if (options_.fastest_memory) health_.setMemory(report_.la.effective_rows);
  const bool la_tells =
      !tracker().holds() && report_.la.effective_rows >= options_.fewestRows(kHorizonsOfSensorCheck, period());
  health_.setSensors(sensors_.judge(report_.la, la_tells));
  report_.health = health_.update(report_.stamp, report_.ls, report_.la);
}

}  // namespace suspension_health_monitor
