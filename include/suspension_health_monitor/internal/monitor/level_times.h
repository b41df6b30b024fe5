#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

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

}  // namespace suspension_health_monitor
