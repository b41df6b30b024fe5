#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/sampling_test.h"

namespace suspension_health_monitor {

/// When the readings of one stream were taken, by their stamps: phase and period of a stream that reads regularly, by
/// one alpha-beta filter, whose gains are those of least squares over the newest 1000 readings (Kalata, IEEE Trans.
/// AES 20 (1984), 174-182). A stamp near the regular time is used as it is, unless the readings show that they were
/// taken regularly (SamplingTest). Where messages were seen to wait, the regular time is used for one farther off,
/// unless they show that they were taken as stamped. Cost per reading: O(1), no allocation.
class StreamClock {
 public:
  static constexpr double kMemory = 0.999;  ///< forgetting factor

  /// Takes in the stamp of the next reading, later than the one before.
  /// @return when the reading was taken, likewise later.
  Stamp add(Stamp stamp, double value);

  /// A reading is kept out, which was taken, too.
  void passOver() { time_ += period_; }

  /// The next reading begins another series: its stamp may be any.
  void interrupt();

  double period() const { return period_; }                     ///< [s]; 0 before the second reading
  double jitter() const { return std::sqrt(jitter_.mean()); }   ///< standard deviation of the spacing [s]
  std::uint64_t lost() const { return lost_ > 0 ? lost_ : 0; }  ///< readings that are missing, pauses left out

 private:
  static constexpr std::size_t kFirst = 512;  // readings that tell the first period

  double medianSpacing(std::size_t over) const;
  double likeliestPeriod(double rough) const;
  void begin(double stamp);
  void follow(double stamp);
  int periodsSinceLast(double stamp);

  std::optional<Stamp> origin_, last_;  // of the series; the newest time returned
  std::array<double, kFirst> first_{};  // stamps [s since the origin]
  std::size_t num_first_ = 0;
  double time_ = 0.0, period_ = 0.0;        // regular time of the newest reading [s since the origin], period [s]
  double stamp_ = 0.0;                      // the newest one, likewise
  double readings_ = 0.0;                   // that phase and period rest on
  double miscount_ = 0.0, evidence_ = 0.0;  // periods that the count may be short of, ln of its likelihood ratio
  double whole_before_ = 0.0;               // periods that the newest reading was off by
  bool messages_wait_ = false;  // a stamp that was off by periods was followed by one that was off by others
  int out_of_step_ = 0;
  RunningMean square_{kMemory}, jitter_{kMemory};  // of the distance from the regular time, of the spacing [s^2]
  std::int64_t lost_ = 0;
  SamplingTest sampling_;
};

}  // namespace suspension_health_monitor
