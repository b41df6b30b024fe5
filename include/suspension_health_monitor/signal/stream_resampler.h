#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/signal/window_sums.h"

namespace suspension_health_monitor {

/// Values of one stream of readings at the instants of a grid of period T, by a low-pass filter for that grid that asks
/// neither for a rate nor for equal spacings. Any two streams so treated have passed the same filter.
///
/// With tau_i the time of reading i from the instant asked for, in T, q_i half the time between its neighbours, h a
/// Kaiser-windowed sinc (half width kHalfWidth, flat to 0.8 of the grid's Nyquist frequency, -6 dB at 1, stop band from
/// 1.2: what folds, folds onto frequencies above 0.8; white noise stays white, by which later judges tell it) and
/// g_i = q_i (1 - (tau_i/kHalfWidth)^2)^2, the value is
///   sum_i w_i x_i,   w_i = q_i h(tau_i) + g_i (a_0 + sum_k a_k cos(k theta tau_i) + b_k sin(k theta tau_i)).
/// On equal spacings the first term alone is that filter. The second makes good what jitter and lost readings do to the
/// quadrature: its 2 kLines + 1 coefficients are chosen so that sinusoids of frequency 0, 0.1, ... 0.6 times the
/// Nyquist frequency pass with gain 1 and phase 0, and so all in between, nearly: lines that lie closer than the
/// window resolves leave no room. A ridge that grows with frequency, none at 0, keeps a hole of several readings from
/// amplifying noise. A constant passes exactly.
/// Cost per value: O(readings in the window); no allocation.
class StreamResampler {
 public:
  static constexpr int kHalfWidth = WindowSums::kHalfWidth;  ///< [grid periods]; so late is a value
  static constexpr std::size_t kCapacity = 8192;             ///< readings

  /// @param period  T of the grid > 0.
  explicit StreamResampler(Stamp period);

  struct Reading {
    Stamp stamp{};
    double acceleration = 0.0;
    bool still = false;      ///< StreamGate::isStill()
    bool after_gap = false;  ///< nothing may be interpolated between the reading before and this one
  };

  bool full() const { return size_ == kCapacity; }
  void dropOldest();

  /// Takes in the next reading, later than the one before. Not when full.
  void push(const Reading& reading);
  void clear();

  /// @return the reading taken in last; nullptr: none is held.
  const Reading* newest() const { return size_ == 0 ? nullptr : &reading(size_ - 1); }

  /// @return the first instant that the readings held can cover; none if there are none.
  std::optional<Stamp> earliest() const;

  enum class Coverage {
    kComes,       ///< readings that the value needs have not come yet
    kCovered,     ///< at() may be called
    kInterrupted  ///< there will never be a value; the readings before the interruption are gone
  };

  /// Looks whether there is a value at t, and forgets what no instant from t on needs.
  /// @param t  not before that of the last call.
  Coverage look(Stamp t);

  struct Value {
    double acceleration;
    bool still;  ///< of the newest reading up to the instant
  };

  /// @param t  that look() has just called covered.
  Value at(Stamp t) const;

 private:
  const Reading& reading(std::size_t i) const { return readings_[(first_ + i) % kCapacity]; }

  Stamp reach_;        // half of the window
  double per_period_;  // [1/ns]
  std::vector<Reading> readings_;
  std::size_t first_ = 0, size_ = 0;
  std::size_t gaps_ = 0;  // among the readings held
};

}  // namespace suspension_health_monitor
