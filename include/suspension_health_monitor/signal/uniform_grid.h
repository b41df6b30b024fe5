#pragma once

#include <array>
#include <optional>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/signal/reject_reason.h"
#include "suspension_health_monitor/signal/stream_gate.h"

namespace suspension_health_monitor {

/// The two sensors of a strut.
enum class Side : std::size_t { kSprung = 0, kUnsprung = 1 };

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

  /// @return what was kept out, of both sensors.
  RejectCounts rejected() const;

  const StreamGate& gate(Side side) const { return gates_[static_cast<std::size_t>(side)]; }

 private:
  struct Reading {
    Stamp stamp;
    double acceleration;
    bool still;  // StreamGate::isStill()
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
  std::optional<CornerSample> match();
  void drop(Queue& queue);
  void startNewSeries(std::size_t other);

  Stamp period_;
  std::array<Queue, 2> waiting_;
  std::array<StreamGate, 2> gates_;
  RejectCounts rejected_;  // by the pairing
};

}  // namespace suspension_health_monitor
