#include "suspension_health_monitor/suspension_monitor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "suspension_health_monitor/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSpacings = 50.0;  // before their mean counts: jitter of half a period shifts it by a hundredth

const MonitorOptions& checked(const MonitorOptions& options) {
  if (!options.sample_period) throw std::invalid_argument("sample_period is not given, must be above 0 [s]");
  options.validate();
  return options;
}

}  // namespace

SuspensionMonitor::SuspensionMonitor(const MonitorOptions& options)
    : options_(checked(options)),
      period_(fromSeconds(*options.sample_period)),
      horizon_samples_(options.horizonSamples(*options.sample_period)),
      plain_(options),
      health_(options.health(*options.sample_period)),
      sensors_(options.gravity_tolerance,
               options.comparison_window / *options.sample_period / health_.options().rows_per_update),
      until_judged_(health_.options().rows_per_update) {}

void SuspensionMonitor::setEffects(const std::vector<ActiveEffect>& effects) {
  if (effects.empty()) {
    if (extended_) static_cast<ModelReport&>(report_) = base_;
    extended_.reset();
    return;
  }
  ModelTracker next = tracker();
  ModelReport report = report_;
  next.setEffects(effects, report);
  if (!extended_) {
    base_ = report_;
    reported_until_ = last_stamp_;
  }
  static_cast<ModelReport&>(report_) = report;
  extended_.emplace(std::move(next));
}

void SuspensionMonitor::reconfigure(const MonitorOptions& options) {
  options_ = checked(options);
  health_.setOptions(options.health(period()));
  plain_.setForgetting(options);
  if (extended_) extended_->setForgetting(options);
}

// Flat: a sample passes a dozen small functions, whose calls alone would cost a fifth of its time.
[[gnu::flatten]] const MonitorReport* SuspensionMonitor::addSample(const CornerSample& sample) {
  if (!isUsable(sample.sprung_acceleration) || !isUsable(sample.unsprung_acceleration)) {
    rejected_.add(RejectReason::kNotFinite);
    return nullptr;
  }
  if (!continues(sample.stamp)) return nullptr;
  last_stamp_ = sample.stamp;
  ++input_.samples;
  const CornerSample* of_row = track(sample);
  if (of_row == nullptr || (reported_until_ && of_row->stamp <= *reported_until_)) return nullptr;
  report_.stamp = of_row->stamp;
  report_.measured = of_row->sprung_acceleration;
  if (--until_judged_ <= 0) judgeHealth(sample);
  return &report_;
}

[[gnu::noinline]] void SuspensionMonitor::judgeHealth(const CornerSample& sample) {
  until_judged_ = health_.options().rows_per_update;
  const CornerSample& previous = in_series_ > 1 ? recent_[(in_series_ - 2) % recent_.size()] : sample;
  const bool enough_rows =
      report_.la.effective_rows >= fewestRows(10 * options_.valid_min_rows, options_.forgetting_factor);
  if (options_.fastest_forgetting_factor) health_.setMemory(report_.la.effective_rows);
  judgePeriod(sample.stamp);
  health_.setSensors(sensors_.look(previous, sample, report_.la, enough_rows));
  report_.health = health_.update(report_.stamp, report_.ls, report_.la);
}

void SuspensionMonitor::countSpacings(Stamp until) {
  spacing_.countUntil(until, in_series_);
  input_.mean_period = spacing_.mean();
}

void SuspensionMonitor::judgePeriod(Stamp stamp) {
  countSpacings(stamp);
  if (spacing_.weight() < kSpacings) return;
  input_.period_fits = std::abs(input_.mean_period / period() - 1.0) <= InputStatus::kPeriodTolerance;
  plain_.setPeriodFits(input_.period_fits, extended_ ? base_ : report_);
  if (extended_) extended_->setPeriodFits(input_.period_fits, report_);
}

// Leads the sample through the models.
// @return the sample that the report is about; nullptr: none yet.
const CornerSample* SuspensionMonitor::track(const CornerSample& sample) {
  if (!first_stamp_) first_stamp_ = sample.stamp;
  const CornerSample* compared = remember(sample);
  if (!extended_) {
    plain_.add(sample, 0.0, compared, report_);
    if (report_.has_row) ++input_.rows;
    return &sample;
  }
  plain_.add(sample, 0.0, compared, base_);
  extended_->lead(base_.la);
  extended_->add(sample, toSeconds(sample.stamp - *first_stamp_), compared, report_);
  if (report_.has_row) ++input_.rows;
  report_.comparison.base_rmse = base_.comparison.rmse;
  report_.comparison.base_fit_percent = base_.comparison.fit_percent;
  return compared;
}

// @return the sample FreeRun::kDelay before this one; nullptr: the series is too short yet.
const CornerSample* SuspensionMonitor::remember(const CornerSample& sample) {
  constexpr std::size_t kMask = std::tuple_size_v<decltype(recent_)> - 1;
  static_assert(kMask >= FreeRun::kDelay && (kMask & (kMask + 1)) == 0);
  const std::size_t number = in_series_++;
  recent_[number & kMask] = sample;
  return number >= FreeRun::kDelay ? &recent_[(number - FreeRun::kDelay) & kMask] : nullptr;
}

bool SuspensionMonitor::continues(Stamp stamp) {
  if (!last_stamp_) {
    spacing_.begin(stamp);
    return true;
  }
  const Stamp spacing = stamp - *last_stamp_;
  switch (continuity(spacing, period_)) {
    case Continuity::kTooSoon: rejected_.add(RejectReason::kTooSoon); return false;
    case Continuity::kContinues: break;
    case Continuity::kGap:
      ++input_.gaps;
      startNewSeries(stamp);
      break;
    case Continuity::kClockJumped:
      ++input_.restarts;
      first_stamp_.reset();
      startNewSeries(stamp);
      plain_.startNewDrive(extended_ ? base_ : report_);
      if (extended_) extended_->startNewDrive(report_);
      break;
  }
  return true;
}

void SuspensionMonitor::startNewSeries(Stamp stamp) {
  countSpacings(*last_stamp_);
  spacing_.begin(stamp);
  in_series_ = 0;
  reported_until_.reset();
  plain_.startNewSeries(extended_ ? base_ : report_);
  if (extended_) extended_->startNewSeries(report_);
}

}  // namespace suspension_health_monitor
