#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/internal/signal/stream_clock.h"

namespace suspension_health_monitor {

/// Predicts readings that were lost from those around them, by the linear least squares that fit the stream so far:
/// with G the sum of v v' over windows v of successive readings, which forgets as StreamClock does, the weights of the
/// known readings are G_known^-1 G_(known, lost). Readings must be equally spaced. The error for a wheel's motion is
/// little more than its noise; that of a polynomial grows as there are fewer readings in a period. Source: N. Wiener,
/// Extrapolation, interpolation and smoothing of stationary time series (1949), with sample moments. Cost: O(kWindow^2)
/// per reading, O(kWindow^3) per loss, no allocation.
class LostReadings {
 public:
  static constexpr int kMost = 3;    ///< readings that are lost in a row
  static constexpr int kReach = 12;  ///< readings before a loss by which it is predicted
  static constexpr int kWindow = 2 * kReach + kMost;

  /// A reading that is known after a loss.
  struct Known {
    int place;  ///< readings since the newest one, the lost ones included
    double value;
  };

  /// Forgets the newest readings, but not what the stream is like: the next one does not follow them.
  void startNewSeries() { in_a_row_ = 0; }

  /// Takes in the next reading, or what was predicted in its place.
  void add(double value);

  /// @return true if enough is known of the stream, and kReach readings before the loss are. With twice as many windows
  /// as weights the variance of the error is twice that of the best weights.
  bool isReady() const { return windows_ >= 2 * kWindow && in_a_row_ >= kReach; }

  /// @param lost  how many follow the newest reading, in [1, kMost].
  /// @param after  readings after these, with places in [lost + 1, kWindow - kReach].
  /// @return one value per lost reading, valid until the next call; empty if they cannot be predicted: the stream does
  /// not change.  @pre isReady()
  const std::vector<double>& predict(int lost, const std::vector<Known>& after);

 private:
  using Window = Eigen::Matrix<double, kWindow, 1>;
  std::optional<double> first_;     // reading, taken off all: the weights do not add up to 1, as a constant would need
  Window newest_ = Window::Zero();  // the oldest first
  int in_a_row_ = 0;                // of the newest readings, up to kWindow
  int windows_ = 0;                 // up to 2 kWindow
  Eigen::Matrix<double, kWindow, kWindow> moments_ = decltype(moments_)::Zero();
  RunningMean power_{StreamClock::kMemory};  // of a window
  std::vector<double> predicted_ = std::vector<double>(kMost);
};

}  // namespace suspension_health_monitor
