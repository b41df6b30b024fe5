#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/signal/stream_silence.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// How long each level held: that of a report until the next one, but no longer than the time-out; what is beyond is
/// kStale, as is what comes before the first report. No allocation.
class LevelTimes {
 public:
  /// @param timeout  after which what is known is old.
  explicit LevelTimes(Stamp timeout) : timeout_(timeout) {}

  /// Takes in what holds from now on.
  void report(HealthLevel level) {
    level_ = level;
    age_ = {};
  }

  /// Lets time pass.
  /// @param become_stale  called when what is known gets old on the way, if it was not kStale already.
  template <class BecomeStale>
  void pass(Stamp duration, const BecomeStale& become_stale) {
    const Stamp fresh = level_ == HealthLevel::kStale ? duration : std::clamp(timeout_ - age_, Stamp::zero(), duration);
    count(fresh);
    if (fresh == duration) return;
    level_ = HealthLevel::kStale;
    become_stale();
    count(duration - fresh);
  }

  HealthLevel level() const { return level_; }    ///< that holds now
  Stamp age() const { return age_; }              ///< of the newest report
  bool isOld() const { return age_ > timeout_; }  ///< what it said is no longer known
  Stamp of(HealthLevel level) const { return durations_[static_cast<std::size_t>(level)]; }
  Stamp elapsed() const { return std::accumulate(durations_.begin(), durations_.end(), Stamp::zero()); }

 private:
  void count(Stamp duration) {
    durations_[static_cast<std::size_t>(level_)] += duration;
    age_ += duration;
  }

  Stamp timeout_;
  HealthLevel level_ = HealthLevel::kStale;
  Stamp age_{};
  std::array<Stamp, 4> durations_{};  // by level
};

/// What a monitor says at one time of recorded drives.
struct HealthMoment {
  Stamp time{};     ///< stamp of the measurement
  Stamp elapsed{};  ///< time that the recordings have covered until then, one after the other
  HealthLevel level = HealthLevel::kStale;
  std::string message;  ///< why, as ~health and /diagnostics say it
  StrutEstimate estimate;
  double offset = std::nan("");  ///< of the wheel carrier's reading against the body's, by LA [m/s^2]
};

/// Writes down what a monitor says over recordings that are read one after the other: every change of level, and how
/// long each level held.
///
/// The time covered is that from the first to the last reading of each recording, by their stamps; none passes between
/// two recordings, nor where the clock goes back. The level is that of the newest report. As in /diagnostics it is
/// kStale once no reading has been accepted for the time-out, and before the first report, and the sensors that were
/// silent meanwhile are named; such a silence lasts no longer than the recording took, whatever a stamp says. Cost per
/// reading and report: O(1); memory grows with the changes only.
class HealthLog {
 public:
  using Sink = std::function<void(const HealthMoment&)>;

  /// @param timeout  silence after which what is known is old.
  /// @param sensors  names, topics, of all whose readings the strut needs.
  /// @param sink  called with every change of level and with the first report of every second between.
  HealthLog(Stamp timeout, const std::vector<std::string>& sensors, Sink sink = {})
      : timeout_(timeout), sink_(std::move(sink)), sensors_(sensors, timeout), times_(timeout) {}

  /// Notes that a sensor of the strut has given a reading, whether or not it will be accepted.
  /// @param sensor  its place.  @param recorded  when it was recorded, by any clock.
  void addReading(std::size_t sensor, Stamp stamp, Stamp recorded);

  /// Takes in a report of what came of the readings so far.
  void addReport(const MonitorReport& report);

  /// The recording ends; the next reading begins another.
  void finishRecording();

  /// @return changes of level in the order of time; the first is the kStale that everything begins with. Of kStale the
  /// message is that of its beginning, and of the last reason that lasted.
  const std::vector<HealthMoment>& events() const { return events_; }

  /// @return the moments at which an early warning began.
  const std::vector<HealthMoment>& earlyWarnings() const { return early_warnings_; }

  /// @return what is known now.
  HealthMoment latest() const;

  /// @return how long a level held; the four of them add up to elapsed().
  Stamp duration(HealthLevel level) const { return times_.of(level); }

  /// @return the time covered.
  Stamp elapsed() const { return times_.elapsed(); }

  /// @return how many of the events are changes to a level.
  std::size_t count(HealthLevel level) const;

 private:
  void goTo(Stamp stamp);
  void advance(Stamp stamp);
  void noteChange(const std::string& message);
  void write(const HealthMoment& moment);
  std::string silence(Stamp duration) const;
  HealthMoment momentOf(const std::string& message) const {
    return {now_.stamp, elapsed(), times_.level(), message, newest_.estimate, newest_.la.offset};
  }

  struct Instant {
    Stamp stamp{}, recorded{};
  };

  Stamp timeout_;
  Sink sink_;
  StreamSilence sensors_;  // of late: since the newest report
  bool in_recording_ = false;
  Instant now_, newest_reading_;
  LevelTimes times_;
  Stamp due_{};             // elapsed() at the next second
  Stamp reason_since_{};    // elapsed() since the newest reason for the level
  std::string begun_with_;  // message of the newest event, when it began
  MonitorReport newest_;
  std::vector<HealthMoment> events_, early_warnings_;
};

}  // namespace suspension_health_monitor
