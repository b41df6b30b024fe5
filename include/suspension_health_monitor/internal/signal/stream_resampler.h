#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/signal/reading_queue.h"
#include "suspension_health_monitor/internal/signal/smoothing_spline.h"

namespace suspension_health_monitor {

/// Values of one stream of readings at the instants of a grid of period T, low-pass filtered for that grid. It asks
/// neither for a rate nor for equal spacings. Any two streams so treated have passed the same filter.
///
/// The readings make a SmoothingSpline on knots T/2 apart, which puts what jitter and lost readings have displaced back
/// into its place. A symmetrical FIR filter takes every second of the spline's values at the knots: a Kaiser-windowed
/// sinc, kHalfWidth periods to either side, flat to 0.8 of the grid's Nyquist frequency, -6 dB at 1, stop band
/// from 1.2. What folds, folds onto frequencies above 0.8, and noise stays nearly white, by which later judges tell it.
/// A constant passes exactly.
///
/// A pause of up to kLongestBridge periods (the grid's or the stream's own, whichever is longer) is bridged.
/// Cost: O(1) per reading and per value, no allocation.
class StreamResampler {
 public:
  static constexpr int kHalfWidth = 8;           ///< [T]; so late is a value
  static constexpr double kLongestBridge = 4.5;  ///< three lost readings in a row, and jitter
  static constexpr double kSlowest = 10.0;       ///< [T]; the period of a stream counts as no longer for that

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
  void begin(const SensorReading& reading);
  void take(const SensorReading& reading);
  bool& stillAt(std::int64_t knot) { return still_[static_cast<std::size_t>(knot & (SmoothingSpline::kKept - 1))]; }

  Stamp period_, reach_;         // reach: half of the window
  std::optional<Stamp> origin_;  // an instant of the grid: knot 0
  std::optional<Stamp> first_;   // reading of the series
  SensorReading last_;
  double reference_ = 0.0;  // taken off all readings: a constant then passes without any rounding
  SmoothingSpline spline_;
  std::array<bool, SmoothingSpline::kKept> still_{};  // of the newest reading up to a knot
  std::int64_t next_knot_ = 0;                        // after the last reading
  std::uint64_t bridged_ = 0;
};

}  // namespace suspension_health_monitor
