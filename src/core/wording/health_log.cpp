#include "suspension_health_monitor/internal/wording/health_log.h"

#include <chrono>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {

constexpr Stamp kLasting = std::chrono::seconds(30);  // of a reason: longer than any start takes

void HealthLog::addReading(std::size_t sensor, Stamp stamp, Stamp recorded) {
  if (stamp <= Stamp::zero()) return;  // no stamp at all
  sensors_.add(sensor, stamp);
  newest_reading_ = {stamp, recorded};
  if (in_recording_) return;
  in_recording_ = true;
  now_ = newest_reading_;
  if (events_.empty()) noteChange(describe(newest_.health));
}

void HealthLog::addReport(const MonitorReport& report) {
  // One that is newer than all readings of this recording is about the end of the one before.
  goTo(std::min(report.stamp, newest_reading_.stamp));
  const HealthLevel before = times_.level();
  times_.report(report.health.level);
  sensors_.forget();
  const HealthReport& health = report.health;
  const auto warns_early = [](const HealthReport& one) {
    return one.early_warning && one.level == HealthLevel::kOk;  // beside a raised level it is none
  };
  const bool begins_early = warns_early(health) && !warns_early(newest_.health);
  const bool is_same = health.doubt == newest_.health.doubt && health.sensor.fault == newest_.health.sensor.fault;
  if (!is_same) reason_since_ = elapsed();
  newest_ = report;
  if (begins_early) early_warnings_.push_back(momentOf(describe(health)));
  if (health.level != before) return noteChange(describe(health));
  if (elapsed() < due_) return;
  write(momentOf(describe(health)));
  if (health.level == HealthLevel::kStale && elapsed() - reason_since_ > kLasting)
    events_.back().message = begun_with_ + "; later: " + describe(health);
}

void HealthLog::finishRecording() {
  sensors_.finish();
  if (in_recording_) goTo(newest_reading_.stamp);
  in_recording_ = false;
}

HealthMoment HealthLog::latest() const {
  return momentOf(times_.isOld() ? silence(times_.age()) : describe(newest_.health));
}

std::string HealthLog::silence(Stamp duration) const {
  return describeNoReading(toSeconds(duration), sensors_.ofLate(), describe(newest_.health));
}

std::size_t HealthLog::count(HealthLevel level) const {
  return static_cast<std::size_t>(
      std::count_if(events_.begin(), events_.end(), [&](const HealthMoment& event) { return event.level == level; }));
}

void HealthLog::goTo(Stamp stamp) {
  // The clock went back; else it is a report that comes late.
  if (stamp < now_.stamp && newest_reading_.stamp < now_.stamp) now_.stamp = stamp;
  if (stamp > now_.stamp) advance(stamp);
  // A report may be late behind the readings; a wrong stamp is not.
  now_.recorded = newest_reading_.recorded - std::clamp(newest_reading_.stamp - now_.stamp, Stamp::zero(), timeout_);
}

void HealthLog::advance(Stamp stamp) {
  const Stamp recorded = newest_reading_.recorded - now_.recorded;
  Stamp step = stamp - now_.stamp;
  if (step > timeout_) step = std::clamp(recorded, Stamp::zero(), step);
  const Stamp silent = times_.age() + step, begin = elapsed();
  times_.pass(step, [&] {
    now_.stamp += elapsed() - begin;
    noteChange(silence(silent));
  });
  now_.stamp = stamp;
}

void HealthLog::noteChange(const std::string& message) {
  events_.push_back(momentOf(message));
  begun_with_ = message;
  reason_since_ = elapsed();
  write(events_.back());
}

void HealthLog::write(const HealthMoment& moment) {
  constexpr Stamp second = std::chrono::seconds(1);
  due_ = elapsed() - elapsed() % second + second;
  if (sink_) sink_(moment);
}

}  // namespace suspension_health_monitor
