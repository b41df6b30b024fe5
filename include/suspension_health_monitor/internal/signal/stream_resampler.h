#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/signal/lost_readings.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {

/// Cubic spline on unit knots through readings at any positions, as they come:
///   s(u) = sum_k c_k B(u - k), whose coefficients minimise
///   sum_i (s(u_i) - x_i)^2 + lambda sum_k 2 (D^3 c)_k^2 + (D^4 c)_k^2,   D c_k = c_k - c_(k-1),
/// with B the cubic B-spline, 0 outside of (-2, 2). The penalty decides where readings are fewer than knots: there it
/// gives the smoothest curve through them, fast motion by its fourth differences, and holes of several readings, which
/// these would fill with noise, by its third. Where readings are more, the sum of squares averages them.
///
/// A reading concerns four neighbouring coefficients, and a term of the penalty at most five. So the normal equations
/// are banded, and are factored from the oldest coefficient on while readings come; only the newest five are open at
/// any time. Back substitution gives coefficients by all readings so far. Those of an instant hardly change once
/// readings of some ten knots after it are in (a fixed-lag smoother), and are then left as they are. Source: P-splines,
/// Eilers and Marx, Statistical Science 11 (1996), 89-121. Cost: O(1) per reading and per knot, no allocation.
class SmoothingSpline {
 public:
  static constexpr std::int64_t kKept = 128;  ///< newest coefficients that solve() can give, a power of two

  /// Forgets all readings; the next one may be at any position.
  void clear() { empty_ = true; }

  /// Takes in the next reading.
  /// @param position  in knots, not before the last one.
  void add(double position, double value);

  /// Solves for the coefficients from `first` to the newest, but for those that are settled.
  /// @param settled  those up to here stay as they are from now on.
  void solve(std::int64_t first, std::int64_t settled);

  /// @return c_first and those after it, as many as solve() has given.
  const double* coefficients(std::int64_t first) const { return &coefficients_[place(first)]; }

 private:
  static constexpr int kOpen = 5;
  /// c_k = value - sum_i factors[i] c_(k+1+i).
  struct Closed {
    std::array<double, kOpen - 1> factors;
    double value;
  };

  static std::size_t place(std::int64_t k) { return static_cast<std::size_t>(k & (kKept - 1)); }
  void begin(std::int64_t first);
  void penalise(const std::array<double, kOpen>& difference);
  void penaliseNewest();
  void eliminateOldest(Closed& closed);

  bool empty_ = true;
  std::int64_t oldest_open_ = 0, settled_ = 0;
  std::array<std::array<double, kOpen>, kOpen> matrix_{};  // of the open coefficients, its lower triangle
  std::array<double, kOpen> right_{};
  std::array<Closed, kKept> closed_{};
  std::array<double, 2 * kKept> coefficients_{};  // twice, so that any kKept are in a row
};

/// Values of one stream of readings at the instants of a grid of period T, low-pass filtered for that grid. It asks
/// neither for a rate nor for equal spacings. Any two streams so treated have passed the same filter.
///
/// The readings make a SmoothingSpline on knots T/2 apart, which puts what jitter and lost readings have displaced back
/// into its place. A symmetrical FIR filter takes every second of the spline's values at the knots: a Kaiser-windowed
/// sinc, kHalfWidth periods to either side, flat to 0.8 of the grid's Nyquist frequency, -6 dB at 1, stop band
/// from 1.2. What folds, folds onto frequencies above 0.8, and noise stays nearly white, by which later judges tell it.
/// A constant passes exactly.
///
/// A pause of up to kSignalTuning.longest_bridge periods (the grid's or the stream's own, whichever is longer) is
/// bridged: by LostReadings, which waits for readings after the loss, or else by the spline. Cost: O(1) per reading and
/// per value, no allocation.
class StreamResampler {
 public:
  static constexpr int kHalfWidth = 8;  ///< [T]; so late is a value, but for losses

  /// @param period  T of the grid > 0.
  explicit StreamResampler(Stamp period);

  /// Forgets all readings: the next instant may be one of another grid.
  void clear();

  /// @param waiting  readings that have not been taken in yet.
  /// @return the first instant that may have a value; none without a reading.
  std::optional<Stamp> earliest(const ReadingQueue& waiting) const;

  enum class Coverage {
    kComes,       ///< readings that the value needs have not come yet
    kCovered,     ///< at() may be called
    kInterrupted  ///< there will never be a value; a new series begins
  };

  /// Takes in the readings that the value at t needs.
  /// @param t  an instant of the grid, not before that of the last call.
  Coverage advance(Stamp t, ReadingQueue& waiting);

  struct Value {
    double value;
    bool still;  ///< of the newest reading up to the instant
  };

  /// @param t  that advance() has just called covered.
  Value at(Stamp t);

  /// @return lost readings that were bridged.
  std::uint64_t bridged() const { return bridged_; }

 private:
  bool followsAfterGap(const SensorReading& reading) const;
  bool fillIn(const ReadingQueue& waiting);
  void begin(const SensorReading& reading);
  void take(const SensorReading& reading);
  bool& stillAt(std::int64_t knot) { return still_[knot & (SmoothingSpline::kKept - 1)]; }

  Stamp period_, reach_;         // reach: half of the window
  std::optional<Stamp> origin_;  // an instant of the grid: knot 0
  std::optional<Stamp> first_;   // reading of the series
  SensorReading last_;
  double reference_ = 0.0;  // taken off all readings: a constant then passes without any rounding
  LostReadings lost_readings_;
  std::vector<LostReadings::Known> after_loss_;
  SmoothingSpline spline_;
  std::array<bool, SmoothingSpline::kKept> still_{};  // of the newest reading up to a knot
  std::int64_t next_knot_ = 0;                        // after the last reading
  std::uint64_t bridged_ = 0;
};

}  // namespace suspension_health_monitor
