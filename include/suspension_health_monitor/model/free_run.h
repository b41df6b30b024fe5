#pragma once

#include <array>
#include <optional>

namespace suspension_health_monitor {

/// The strut model (27) driven by the measured wheel acceleration alone:
///   d'' = w''_measured - z''_model(d, v),   z''_model = b1 v + b0 d.
/// The spring holds the travel d, so nothing drifts, unlike an integration of the accelerations; the prediction is free
/// of the noise on the body's sensor.
///
/// A constant a in w'' (gravity, tilt, offset) moves the travel by a / b0 and comes out again as a in the prediction.
/// Between samples w'' follows the cubic through the newest four; straight lines would double the residual of a car on
/// a rough road. Integration: classical Runge-Kutta, split so that no step is longer than 0.35 / sqrt(b0) or 0.35 / b1.
/// Cost per sample: O(1) for a given model, no allocation.
class FreeRun {
 public:
  /// @param period  sampling time T > 0 [s].
  explicit FreeRun(double period);

  /// @return true if the model is stable and the sampling can follow it: b1 > 0, b0 > 0, at most 32 steps per sample.
  bool accepts(double damping_to_mass, double stiffness_to_mass) const;

  /// Changes the model if it is acceptable. The spring's force b0 d and the travel rate go on, so that gravity stays in
  /// balance when an estimate of b0 moves: with the travel kept, 1 % of b0 would shake the prediction by 0.1 m/s^2.
  /// @return accepts(); if false, the model stays as it was.
  bool trySetModel(double damping_to_mass, double stiffness_to_mass);

  /// As trySetModel().
  /// @param damping_to_mass  b1 [1/s].  @param stiffness_to_mass  b0 [1/s^2].
  /// @throws std::invalid_argument  naming the value that makes the model unacceptable.
  void setModel(double damping_to_mass, double stiffness_to_mass);

  /// Takes in the next sample of an uninterrupted uniform series of w'' [m/s^2].
  /// @return the predicted body acceleration z'' at this sample [m/s^2]; nothing before a model is set and four samples
  /// have come.
  std::optional<double> push(double unsprung_acceleration);

  /// @return true once the unknown initial travel has decayed to 1e-3 of itself.
  bool settled() const { return decayed_ >= kSettledDecay; }

  double travel() const { return state_[0]; }      ///< d [m]
  double travelRate() const { return state_[1]; }  ///< v [m/s]

  /// Forgets travel and input, keeps the model: for a gap in the series.
  void reset();

 private:
  using State = std::array<double, 2>;  // d, v

  static constexpr double kSettledDecay = 6.9;  // ln 1000
  static constexpr std::size_t kNodes = 4;      // of the interpolating cubic

  double exactSteps(double damping_to_mass, double stiffness_to_mass) const;
  void advance();
  double interpolate(double fraction) const;
  State derivative(const State& state, double unsprung_acceleration) const;

  double period_;
  double damping_to_mass_ = 0.0, stiffness_to_mass_ = 0.0;
  double decay_rate_ = 0.0;  // of the slowest free motion [1/s]
  int num_steps_ = 0;        // per sample; 0: no model yet
  State state_{};
  std::array<double, kNodes> input_{};  // newest first
  std::size_t num_inputs_ = 0;
  double decayed_ = 0.0;  // e-foldings since the start
};

}  // namespace suspension_health_monitor
