#pragma once

#include <Eigen/Core>
#include <vector>

namespace suspension_health_monitor {

/// Predicts readings that were lost from those around them, as the least-squares line does that fits the stream so far:
/// with G the sum of v v' over windows v of successive readings, which forgets as StreamClock does, the weights of the
/// known readings are G_known^-1 G_(known, lost). Where the stream is regular this misses the motion of a wheel by
/// little more than noise; a polynomial misses it by the more the fewer readings there are in a period. Source: N.
/// Wiener, Extrapolation, interpolation and smoothing of stationary time series (1949), with sample moments. Cost:
/// O(kWindow^2) per reading, O(kWindow^3) per loss, no allocation.
class LostReadings {
 public:
  static constexpr int kMost = 3;    ///< readings that are lost in a row
  static constexpr int kReach = 12;  ///< readings before a loss by which it is predicted
  static constexpr int kWindow = 2 * kReach + kMost;

  /// A reading that is known after a loss.
  struct Known {
    int place;     ///< readings since the newest one, the lost ones included, up to kWindow - kReach
    double value;  ///< as add() takes it
  };

  /// Forgets the newest readings, but not what the stream is like: the next one does not follow them.
  void startNewSeries() { in_a_row_ = 0; }

  /// Takes in the next reading, or what was predicted in its place.
  /// @param value  less a constant that is the same for all.
  void add(double value);

  /// @return true if enough is known of the stream to predict from kReach readings before the loss.
  bool isReady() const { return windows_ >= kFewestWindows && in_a_row_ >= kReach; }

  /// @param lost  how many follow the newest reading, in [1, kMost].
  /// @param after  readings that are known after these.
  /// @return one value per lost reading, valid until the next call; empty if they cannot be told.  @pre isReady()
  const std::vector<double>& predict(int lost, const std::vector<Known>& after);

 private:
  // From twice as many windows as weights the line leaves twice the variance that the best one does.
  static constexpr double kFewestWindows = 2.0 * kWindow;

  using Window = Eigen::Matrix<double, kWindow, 1>;
  Window newest_ = Window::Zero();  // the oldest first
  Eigen::Matrix<double, kWindow, kWindow> moments_ = decltype(moments_)::Zero();
  int in_a_row_ = 0;      // of the newest readings, up to kWindow
  double windows_ = 0.0;  // so far
  std::vector<double> predicted_ = std::vector<double>(kMost);
};

}  // namespace suspension_health_monitor
