#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/identification/running_mean.h"
#include "suspension_health_monitor/signal/alignment.h"

namespace suspension_health_monitor {

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

/// Brings the readings of the sensors onto one clock: pairs those whose stamps agree within half a sample.
/// The result does not depend on the order in which the streams interleave, as long as none runs more than
/// kMostWaiting readings ahead, so that a replay gives what the live run gave.
/// A road sensor, if there is one, is waited for, but no longer than kMostRoadLag readings of the others: a strut does
/// not need it. Cost per reading: O(1) amortised, no allocation.
class UniformGrid {
 public:
  static constexpr std::size_t kMostWaiting = 4096;
  static constexpr std::size_t kMostRoadLag = 64;

  /// @param period  sampling time T > 0 [s].
  explicit UniformGrid(double period, const GridOptions& options = {});

  /// Takes in one reading of one sensor; each stream comes in the order in which it was measured.
  /// @param acceleration  along the strut, up positive [m/s^2].
  /// @return the first sample that this reading completes, stamped by the sprung sensor. It may complete several:
  ///     for (auto sample = grid.push(side, stamp, acceleration); sample; sample = grid.next())
  std::optional<CornerSample> push(Side side, Stamp stamp, double acceleration);

  /// @return the next sample that the readings so far complete.
  std::optional<CornerSample> next() { return match(); }

  /// @return the road's acceleration at the sample given last [m/s^2]; none without a reading near it.
  std::optional<double> roadAcceleration() const { return road_acceleration_; }

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
  bool findRoad(Stamp stamp);
  void drop(Queue& queue);
  void startNewSeries();

  Stamp period_;
  GridOptions options_;
  std::array<Queue, kMostStreams> waiting_;
  std::array<std::optional<Stamp>, kMostStreams> last_;
  std::array<RunningMean, kMostStreams> usual_{RunningMean(kUsualMemory), RunningMean(kUsualMemory),
                                               RunningMean(kUsualMemory)};  // |acceleration|
  std::array<int, kMostStreams> absurd_in_a_row_{};
  bool road_is_silent_ = false;
  std::optional<double> road_acceleration_;
  RejectCounts rejected_;
};

}  // namespace suspension_health_monitor
