#pragma once

#include <boost/circular_buffer.hpp>
#include <optional>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/health/sensor_check.h"
#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// The samples as uninterrupted uniform series: what may be taken in, where a series ends, whether the period is the
/// one that was said. Cost per sample: O(1), no allocation.
class SampleSeries {
 public:
  explicit SampleSeries(Stamp period);

  /// Takes in the next sample if it can be.
  /// @return how it follows the one before, kGap and kClockJumped beginning a new series; empty: it was rejected.
  std::optional<Continuity> add(const CornerSample& sample);

  void countRow() { ++status_.rows; }

  /// Judges the spacings up to now.
  void judge();

  /// Notes what is known of the sensors.
  void note(const SensorCheck& sensors) {
    status_.beyond_strut = sensors.bodyBeyondStrut();
    status_.beyond_strut_level = sensors.bodyBeyondStrutLevel();
    status_.unit_fits = sensors.report().fault != SensorFault::kInG;
  }

  /// @return the sample FreeRun::kDelay before the newest one; nullptr: the series is too short yet.
  const CornerSample* delayed() const;

  /// @return the newest stamp; Stamp::zero() before the first.
  Stamp newest() const { return last_.value_or(Stamp::zero()); }

  /// @return time of the newest sample since the start of the drive [s].
  double time() const { return first_ ? toSeconds(*last_ - *first_) : 0.0; }

  Stamp period() const { return period_; }
  const InputStatus& status() const { return status_; }
  const RejectCounts& rejected() const { return rejected_; }

 private:
  Stamp period_;
  std::optional<Stamp> first_, last_;                                 // of the drive
  boost::circular_buffer<CornerSample> recent_{FreeRun::kDelay + 1};  // of the series
  RunningMean spacing_;
  InputStatus status_;
  RejectCounts rejected_;
};

}  // namespace suspension_health_monitor
