#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"

namespace suspension_health_monitor {

/// The first readings of several streams, which wait until their stamps have told the sampling time.
/// @tparam Value  of a reading.
template <class Value>
class EarlyReadings {
 public:
  static constexpr std::size_t kSpacings = 50;  ///< of each required stream, to tell the sampling time

  struct Reading {
    std::size_t stream;
    Stamp stamp;
    Value value;
  };

  /// @param is_required  by stream; one at least.
  /// @param most_per_stream  readings that may wait of each required stream: more, and one of them is silent.
  EarlyReadings(const std::vector<bool>& is_required, std::size_t most_per_stream)
      : is_required_(is_required), measurement_(kSpacings, is_required), rejected_(is_required.size()) {
    for (const bool required : is_required) most_ += required ? most_per_stream : 0;
  }

  /// Takes in the next reading, or keeps it out.
  /// @return the sampling time [s] once it is known.
  std::optional<double> add(Reading reading) {
    RejectCounts& rejected = rejected_[reading.stream];
    const bool goes_back = measurement_.goesBack(reading.stream, reading.stamp);
    if (!measurement_.add(reading.stream, reading.stamp))
      rejected.add(reading.stamp == Stamp::zero() ? RejectReason::kZeroStamp : RejectReason::kRepeatedStamp);
    else if (goes_back)
      rejected.add(RejectReason::kTimeWentBack);
    else
      keep(std::move(reading));
    return measurement_.period();
  }

  /// @return the oldest of those that wait, which waits no longer; nothing if there is none.
  std::optional<Reading> next() {
    if (next_ < waiting_.size()) return std::move(waiting_[next_++]);
    waiting_ = {};
    next_ = 0;
    return std::nullopt;
  }

  /// A reading that has to wait though the sampling time is known: older ones do.
  void append(Reading reading) { waiting_.push_back(std::move(reading)); }

  bool isEmpty() const { return next_ == waiting_.size(); }

  /// @return those of one stream that were kept out, and of all.
  const RejectCounts& rejected(std::size_t stream) const { return rejected_[stream]; }
  RejectCounts rejected() const {
    RejectCounts all;
    for (const RejectCounts& each : rejected_) all += each;
    return all;
  }

 private:
  void keep(Reading reading) {
    if (waiting_.size() == most_) {
      for (const Reading& each : waiting_) rejected_[each.stream].add(RejectReason::kMissingPartner);
      waiting_.clear();
      measurement_ = PeriodMeasurement(kSpacings, is_required_);
    }
    waiting_.push_back(std::move(reading));
  }

  std::vector<bool> is_required_;
  PeriodMeasurement measurement_;
  std::size_t most_ = 0;
  std::vector<Reading> waiting_;
  std::size_t next_ = 0;
  std::vector<RejectCounts> rejected_;
};

}  // namespace suspension_health_monitor
