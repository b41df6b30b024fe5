#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {

/// The sampling time of several streams, measured from their stamps: that of the slowest stream that is required. Of
/// each stream it is the mean of all spacings between half and one and a half times their median. The median passes
/// over gaps and clocks that jump, as long as they are the minority; the mean of n spacings has 1/n of their jitter.
class PeriodMeasurement {
 public:
  static constexpr std::size_t kFewestOfRecording = 10;  ///< spacings that tell the period of something recorded

  /// @param spacings_wanted  of each required stream before a period is given, >= 1.
  /// @param is_required  by stream; one at least. By default those of a strut alone, numbered by Side.
  explicit PeriodMeasurement(std::size_t spacings_wanted, const std::vector<bool>& is_required = {true, true, false})
      : spacings_wanted_(spacings_wanted), is_required_(is_required), streams_(is_required.size()) {}

  /// @return what is wrong with the stamp after the one before of its stream; empty: nothing.
  std::optional<RejectReason> add(std::size_t stream, Stamp stamp);
  std::optional<RejectReason> add(Side side, Stamp stamp) { return add(indexOf(side), stamp); }

  /// Forgets all stamps.
  void restart() { streams_.assign(streams_.size(), {}); }

  /// @return the sampling time [s], nothing until all required streams have shown enough spacings.
  std::optional<double> period() const;

 private:
  struct Stream {
    std::optional<Stamp> last;
    std::vector<Stamp> spacings;
  };

  std::size_t spacings_wanted_;
  std::vector<bool> is_required_;
  std::vector<Stream> streams_;
};

/// The first readings of several streams, which wait until their stamps have told the sampling time.
class FirstReadings {
 public:
  static constexpr std::size_t kSpacings = 50;  ///< of each required stream, to tell the sampling time

  struct Reading {
    std::size_t stream;
    Stamp stamp;
    std::vector<double> values;
  };

  /// @param is_required  by stream; one at least.
  explicit FirstReadings(const std::vector<bool>& is_required)
      : measurement_(kSpacings, is_required), rejected_(is_required.size()) {
    for (const bool required : is_required) most_ += required ? kMostWaiting : 0;
  }

  /// Takes in the next reading, or keeps it out.
  /// @return the sampling time [s] once it is known.
  std::optional<double> add(Reading reading) {
    if (const std::optional<RejectReason> fault = measurement_.add(reading.stream, reading.stamp)) {
      rejected_[reading.stream].add(*fault);
      return measurement_.period();
    }
    if (waiting_.size() == most_) {
      for (const Reading& each : waiting_) rejected_[each.stream].add(RejectReason::kMissingPartner);
      waiting_.clear();
      measurement_.restart();
    }
    append(std::move(reading));
    return measurement_.period();
  }

  /// @return the oldest of those that wait, which waits no longer; nothing if there is none.
  std::optional<Reading> next() {
    if (waiting_.empty()) return std::nullopt;
    Reading oldest = std::move(waiting_.front());
    waiting_.pop_front();
    return oldest;
  }

  /// A reading that has to wait though the sampling time is known: older ones do.
  void append(Reading reading) { waiting_.push_back(std::move(reading)); }

  bool isEmpty() const { return waiting_.empty(); }

  /// @return those of one stream that were kept out.
  const RejectCounts& rejected(std::size_t stream) const { return rejected_[stream]; }

 private:
  PeriodMeasurement measurement_;
  std::size_t most_ = 0;  // that may wait: more, and a required stream is silent
  std::deque<Reading> waiting_;
  std::vector<RejectCounts> rejected_;
};

}  // namespace suspension_health_monitor
