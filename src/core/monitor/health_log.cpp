#include "suspension_health_monitor/internal/monitor/health_log.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {

void HealthLog::addReading(std::size_t sensor, Stamp stamp, Stamp recorded) {
  if (stamp <= Stamp::zero()) return;  // no stamp at all
  noteSilence(sensor);
  silence_.add(sensor, stamp);
  newest_reading_ = stamp;
  newest_recorded_ = recorded;
  if (in_recording_) return;
  in_recording_ = true;
  now_ = stamp;
  recorded_ = recorded;
  if (events_.empty()) changeTo(HealthLevel::kStale, describe(health_));
}

void HealthLog::addReport(const MonitorReport& report) {
  // One that is newer than all readings of this recording is about the end of the one before.
  goTo(std::min(report.stamp, newest_reading_));
  reported_ = elapsed_;
  std::fill(was_silent_.begin(), was_silent_.end(), false);
  const bool begins_early = report.health.early_warning && !health_.early_warning;
  health_ = report.health;
  la_ = report.la;
  if (begins_early) early_warnings_.push_back(momentOf(describe(health_)));
  if (health_.level != level_)
    changeTo(health_.level, describe(health_));
  else if (elapsed_ >= due_)
    write(momentOf(describe(health_)));
}

void HealthLog::finishRecording() {
  for (std::size_t i = 0; i < sensors_.size(); ++i) noteSilence(i);
  silence_.finish();
  if (in_recording_) goTo(newest_reading_);
  in_recording_ = false;
}

// Its next reading ends a silence.
void HealthLog::noteSilence(std::size_t sensor) {
  if (silence_.lasting(sensor) > Stamp::zero()) was_silent_[sensor] = true;
}

HealthMoment HealthLog::latest() const {
  return momentOf(elapsed_ > reported_ + timeout_ ? silence(elapsed_) : describe(health_));
}

std::string HealthLog::silence(Stamp until) const {
  std::vector<std::string> silent;
  for (std::size_t i = 0; i < sensors_.size(); ++i)
    if (was_silent_[i] || silence_.lasting(i) > Stamp::zero()) silent.push_back(sensors_[i]);
  return describeNoReading(toSeconds(until - reported_), silent, describe(health_));
}

std::size_t HealthLog::count(HealthLevel level) const {
  return static_cast<std::size_t>(
      std::count_if(events_.begin(), events_.end(), [&](const HealthMoment& event) { return event.level == level; }));
}

void HealthLog::goTo(Stamp stamp) {
  if (stamp < now_ && newest_reading_ < now_) now_ = stamp;  // the clock went back, not a report that comes late
  if (stamp > now_) advance(stamp);
  // A report may be late behind the readings; a wrong stamp is not.
  recorded_ = newest_recorded_ - std::clamp(newest_reading_ - now_, Stamp::zero(), timeout_);
}

void HealthLog::advance(Stamp stamp) {
  const Stamp recorded = newest_recorded_ - recorded_;
  Stamp step = stamp - now_;
  if (step > timeout_) step = std::clamp(recorded, Stamp::zero(), step);
  const Stamp until = elapsed_ + step, old_at = std::max(elapsed_, reported_ + timeout_);
  if (until > old_at && level_ != HealthLevel::kStale) {
    pass(old_at - elapsed_);
    changeTo(HealthLevel::kStale, silence(until));
  }
  pass(until - elapsed_);
  now_ = stamp;
}

void HealthLog::pass(Stamp duration) {
  durations_[static_cast<std::size_t>(level_)] += duration;
  elapsed_ += duration;
  now_ += duration;
}

void HealthLog::changeTo(HealthLevel level, const std::string& message) {
  level_ = level;
  events_.push_back(momentOf(message));
  write(events_.back());
}

void HealthLog::write(const HealthMoment& moment) {
  constexpr Stamp second = std::chrono::seconds(1);
  due_ = elapsed_ - elapsed_ % second + second;
  if (sink_) sink_(moment);
}

}  // namespace suspension_health_monitor
