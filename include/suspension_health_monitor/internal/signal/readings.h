#pragma once

#include <array>
#include <boost/circular_buffer.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <string_view>

#include "suspension_health_monitor/internal/base/corner_sample.h"

namespace suspension_health_monitor {

/// How a sample follows the one before it in a uniform series of period T.
enum class Continuity {
  kContinues,   ///< spacing within (T/2, 3T/2)
  kTooSoon,     ///< spacing up to T/2: more samples than the period allows
  kGap,         ///< spacing of 3T/2 or more: at least one sample is missing
  kClockJumped  ///< the clock went back
};

inline Continuity continuity(Stamp spacing, Stamp period) {
  if (spacing < Stamp::zero()) return Continuity::kClockJumped;
  if (2 * spacing <= period) return Continuity::kTooSoon;
  return 2 * spacing >= 3 * period ? Continuity::kGap : Continuity::kContinues;
}

/// Why a reading was kept out.
enum class RejectReason : std::size_t {
  kNotMeasured,     ///< the message says that it carries no acceleration, or no angular rate (covariance -1)
  kNotFinite,       ///< NaN, infinite, or too large to be computed with (isUsable())
  kAbsurd,          ///< more than 1000 m/s^2 and a hundred times the median of this sensor
  kZeroStamp,       ///< stamp 0 in a series that has stamps
  kRepeatedStamp,   ///< same stamp as the reading before
  kTimeWentBack,    ///< older than the reading before; a jump far back starts a new series
  kMissingPartner,  ///< no reading of the other sensor within half a sample
  kTooSoon,         ///< less than half a sample after the one before: sample_period is too long for this input
  kClipped,         ///< at the end of the sensor's range
  kStuck,           ///< the same value again and again while the other sensor moves
  kNoTransform,     ///< nobody has told how this sensor is mounted
};
inline constexpr std::array<std::string_view, 11> kRejectReasonNames{
    "not_measured",    "not_finite", "absurd",  "zero_stamp", "repeated_stamp", "time_went_back",
    "missing_partner", "too_soon",   "clipped", "stuck",      "no_transform"};

/// Number of rejected readings by reason.
class RejectCounts {
 public:
  void add(RejectReason reason) { ++counts_[static_cast<std::size_t>(reason)]; }
  std::uint64_t count(RejectReason reason) const { return counts_[static_cast<std::size_t>(reason)]; }
  std::uint64_t total() const { return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}); }
  /// @return the counts by name; only of reasons that occurred.
  std::map<std::string, std::uint64_t> byName() const {
    std::map<std::string, std::uint64_t> counts;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (counts_[i] > 0) counts[std::string(kRejectReasonNames[i])] = counts_[i];
    return counts;
  }
  RejectCounts& operator+=(const RejectCounts& other) {
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
    return *this;
  }

 private:
  std::array<std::uint64_t, kRejectReasonNames.size()> counts_{};
};

/// One reading of one stream that has passed its StreamGate.
struct SensorReading {
  Stamp stamp{};
  Stamp taken{};               ///< when it was taken, by StreamClock
  double value = 0.0;          ///< in the stream's unit
  bool still = false;          ///< StreamGate::isStill()
  double stream_period = 0.0;  ///< StreamClock::period() of its stream by then [s]; 0: not known yet
};

inline constexpr std::size_t kMostWaiting = 4096;  ///< readings of one stream for those of another

/// Readings of one stream that wait for those of another: first in, first out, of fixed capacity, kMostWaiting.
using ReadingQueue = boost::circular_buffer<SensorReading>;

}  // namespace suspension_health_monitor
