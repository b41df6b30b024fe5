#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/identification/running_mean.h"

namespace suspension_health_monitor {

/// The two sensors of a strut.
enum class Side : std::size_t { kSprung = 0, kUnsprung = 1 };

/// Why a reading was kept out.
enum class RejectReason : std::size_t {
  kNotMeasured,     ///< the message says that it carries no acceleration (covariance -1)
  kNotFinite,       ///< NaN, infinite or absurdly large (isUsable())
  kAbsurd,          ///< a million times what this sensor has read on average, for at most three readings
  kZeroStamp,       ///< stamp 0 in a series that has stamps
  kRepeatedStamp,   ///< same stamp as the reading before
  kTimeWentBack,    ///< older than the reading before; a jump far back starts a new series
  kMissingPartner,  ///< no reading of the other sensor within half a sample
  kTooSoon,         ///< less than half a sample after the one before: sample_period is too long for this input
};
inline constexpr std::array<std::string_view, 8> kRejectReasonNames{
    "not_measured", "not_finite", "absurd", "zero_stamp", "repeated_stamp", "time_went_back",
    "missing_partner", "too_soon"};

/// Number of rejected readings by reason.
class RejectCounts {
 public:
  void add(RejectReason reason) { ++counts_[static_cast<std::size_t>(reason)]; }
  std::uint64_t count(RejectReason reason) const { return counts_[static_cast<std::size_t>(reason)]; }
  std::uint64_t total() const;
  RejectCounts& operator+=(const RejectCounts& other);

 private:
  std::array<std::uint64_t, kRejectReasonNames.size()> counts_{};
};

/// Brings the readings of the two sensors onto one clock: pairs those whose stamps agree within half a sample.
/// The result does not depend on the order in which the two streams interleave, as long as neither runs more than
/// kMostWaiting readings ahead, so that a replay gives what the live run gave.
/// Cost per reading: O(1) amortised, no allocation.
class UniformGrid {
 public:
  static constexpr std::size_t kMostWaiting = 4096;

  /// @param period  sampling time T > 0 [s].
  explicit UniformGrid(double period);

  /// Takes in one reading of one sensor; each stream comes in the order in which it was measured.
  /// @param acceleration  along the strut, up positive [m/s^2].
  /// @return the sample that this reading completes, stamped by the sprung sensor.
  std::optional<CornerSample> push(Side side, Stamp stamp, double acceleration);

  const RejectCounts& rejected() const { return rejected_; }

 private:
  static constexpr double kUsualMemory = 0.999;  // forgetting factor

  struct Reading {
    Stamp stamp;
    double acceleration;
  };

  /// First in, first out, of fixed capacity.
  class Queue {
   public:
    Queue() : readings_(kMostWaiting) {}
    bool empty() const { return size_ == 0; }
    bool full() const { return size_ == kMostWaiting; }
    const Reading& front() const { return readings_[first_]; }
    void push(const Reading& reading) { readings_[(first_ + size_++) % kMostWaiting] = reading; }
    void pop() {
      first_ = (first_ + 1) % kMostWaiting;
      --size_;
    }
    std::size_t size() const { return size_; }

   private:
    std::vector<Reading> readings_;
    std::size_t first_ = 0;
    std::size_t size_ = 0;
  };

  bool admit(Side side, Stamp stamp, double acceleration);
  bool isAbsurd(std::size_t index, double acceleration);
  std::optional<CornerSample> match();
  void drop(Queue& queue);
  void startNewSeries();

  Stamp period_;
  std::array<Queue, 2> waiting_;
  std::array<std::optional<Stamp>, 2> last_;
  std::array<RunningMean, 2> usual_{RunningMean(kUsualMemory), RunningMean(kUsualMemory)};  // |acceleration|
  std::array<int, 2> absurd_in_a_row_{};
  RejectCounts rejected_;
};

}  // namespace suspension_health_monitor
