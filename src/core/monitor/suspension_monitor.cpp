#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/internal/signal/period_measurement.h"

namespace suspension_health_monitor {
namespace {

// Horizons that LA needs before it may accuse a sensor, and shortest memory of the means of readings.
constexpr double kHorizonsOfSensorCheck = 17.0;
constexpr double kChecksPerHorizon = 1.5;  // of the sensors: samples within a horizon say much the same

constexpr double kPeriodTolerance = 0.02;  // an error of e makes b1 wrong by e and b0 by 2 e

const MonitorSettings& checked(const MonitorSettings& options) {
  if (!options.sample_period) throw std::invalid_argument("sample_period is not given, must be above 0 [s]");
  options.validate();
  return options;
}

}  // namespace

SuspensionMonitor::SuspensionMonitor(const MonitorSettings& options, bool has_own_blocks)
    : options_(checked(options)),
      horizon_samples_(options.horizonSamples(*options.sample_period)),
      period_(fromSeconds(*options.sample_period)),
      spacing_(1.0 - 0.1 / FirstReadings::kSpacings),
      plain_(options, has_own_blocks),
      health_(options),
      sensors_(std::max(options.comparison_window / *options.sample_period, kHorizonsOfSensorCheck * horizon_samples_),
               horizon_samples_) {}

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
    reported_until_ = last_.value_or(Stamp::zero());
  }
  static_cast<ModelReport&>(report_) = report;
  extended_.emplace(std::move(next));
}

void SuspensionMonitor::reconfigure(const MonitorSettings& options) {
  options_ = checked(options);
  health_.setOptions(options);
  has_new_estimate_ = true;  // the newest estimate is judged by them at once
  changeModels([&](ModelTracker& model, ModelReport&) { model.setOptions(options); });
}

void SuspensionMonitor::addReading(Side side, Stamp stamp, double acceleration) {
  if (!isUsable(acceleration)) return;
  changeModels([&](ModelTracker& model, ModelReport& report) {
    const bool is_new = model.addReading(side, stamp, acceleration, report);
    has_new_estimate_ = has_new_estimate_ || (is_new && &model == &tracker());
  });
}

void SuspensionMonitor::addTemperature(Stamp stamp, double celsius) {
  if (std::isfinite(celsius)) temperature_ = {stamp, celsius};
}

void SuspensionMonitor::takeEstimate(const TopEstimate& estimate, const Eigen::Vector2d& model_stddev) {
  plain_.takeEstimate(estimate, model_stddev, extended_ ? base_ : report_);
  has_new_estimate_ = has_new_estimate_ || !extended_;
}

const MonitorReport* SuspensionMonitor::addGridSample(const CornerSample& sample) {
  const std::optional<Continuity> how = follow(sample);
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
  const auto every = static_cast<std::uint64_t>(std::max(1.0, horizon_samples_ / kChecksPerHorizon));
  if (samples_++ % every == 0 || has_new_estimate_) judgeSensors();
  return &report_;
}

// Notes where a series ends, and whether samples come at the period that was said.
// @return how the sample follows the one before, kGap and kClockJumped beginning a new series; empty: it was rejected.
std::optional<Continuity> SuspensionMonitor::follow(const CornerSample& sample) {
  if (!isUsable(sample.sprung_acceleration) || !isUsable(sample.unsprung_acceleration)) {
    rejected_.add(RejectReason::kNotFinite);
    return std::nullopt;
  }
  const Continuity how = last_ ? continuity(sample.stamp - *last_, period_) : Continuity::kContinues;
  if (how == Continuity::kTooSoon) {
    rejected_.add(RejectReason::kTooSoon);
    return std::nullopt;
  }
  if (how == Continuity::kGap) ++input_.gaps;
  if (how == Continuity::kClockJumped) ++input_.restarts;
  if (how != Continuity::kContinues) {
    recent_.clear();
  } else if (last_) {
    spacing_.add(toSeconds(sample.stamp - *last_));
    input_.mean_period = spacing_.mean();
  }
  if (!first_ || how == Continuity::kClockJumped) first_ = sample.stamp;
  last_ = sample.stamp;
  ++input_.samples;
  recent_.push_back(sample);
  return how;
}

// Leads the sample through the models.
// @return the sample that the report is about; nullptr: none yet.
const CornerSample* SuspensionMonitor::track(const CornerSample& sample) {
  const CornerSample* compared = recent_.full() ? &recent_.front() : nullptr;  // FreeRun::kDelay before the newest
  const double time = toSeconds(sample.stamp - *first_);
  plain_.add(sample, time, compared, extended_ ? base_ : report_);
  if (extended_) {
    extended_->lead(base_.la);
    has_new_estimate_ = extended_->add(sample, time, compared, report_) || has_new_estimate_;
    report_.comparison.base_rmse = base_.comparison.rmse;
    report_.comparison.base_fit_percent = base_.comparison.fit_percent;
  }
  if (report_.has_row) ++input_.rows;
  return extended_ ? compared : &sample;
}

void SuspensionMonitor::judgeSensors() {
  // What their check found last time: it judges below.
  input_.beyond_strut = sensors_.bodyBeyondStrut();
  input_.beyond_strut_level = sensors_.bodyBeyondStrutLevel();
  input_.unit_fits = sensors_.report().fault != SensorFault::kInG;
  // By then jitter of half a period shifts their mean by a hundredth.
  if (spacing_.weight() >= FirstReadings::kSpacings)
    input_.period_fits = std::abs(input_.mean_period / toSeconds(period_) - 1.0) <= kPeriodTolerance;
  changeModels([&](ModelTracker& model, ModelReport& report) { model.setInput(input_, *last_, report); });
  const bool la_tells =
      !tracker().holds() && report_.la.effective_rows >= options_.fewestRows(kHorizonsOfSensorCheck, period());
  const bool is_fresh = temperature_ && toSeconds(report_.stamp - temperature_->first) < options_.oldest_data;
  report_.estimate.temperature = is_fresh ? std::optional(temperature_->second) : std::nullopt;
  health_.setSensors(sensors_.judge(report_.estimate, report_.la, la_tells));
  if (report_.estimate.tellsChanges()) health_.watch(report_.ls);
  report_.health = health_.update(report_.stamp, report_.estimate, std::exchange(has_new_estimate_, false));
}

}  // namespace suspension_health_monitor
