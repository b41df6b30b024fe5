#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/math/delay_line.h"
#include "suspension_health_monitor/internal/model/strut_integrator.h"

namespace suspension_health_monitor {

/// A free run has run away when its prediction is so many times as large as the largest acceleration that was measured.
inline constexpr double kRunaway = 1e3;

/// @throws std::invalid_argument  if there are more than kMostEffects, if an effect has no law or not its number of
/// shapes, or if a value is not finite.
void requireUsable(const std::vector<ActiveEffect>& effects);

/// The strut model (27), with or without effects, driven by the measured wheel acceleration alone:
///   d'' = w''_measured - z''_model,   z''_model = b1 v + b0 d + sum_j c_j f_j(d, v, t, s_j).
/// The spring holds the travel d, so nothing drifts, unlike an integration of the accelerations; the prediction is free
/// of the noise on the body's sensor. It is the prediction that is compared with the measurement, the observer of the
/// travel that effects depend on, the source of instruments. Fits run the same over recorded drives (runFree()).
///
/// Between samples w'' is interpolated from as many samples after an instant as before it, as a causal interpolation
/// would leave errors of the size of the sensor noise on a rough road: the run answers kDelay samples late.
/// Integration: integrateStrut(), split so that no step is longer than 0.35 / sqrt(b0) or 0.35 / b1.
///
/// A constant a in w'' (gravity, tilt, offset) moves the travel by a / b0 and comes out again as a in the prediction.
/// The linear laws let it pass, others do not: with effects in the model travel is counted from a / b0, with a the
/// mean of w'', of all samples at first, then with a memory of 100 natural periods 2 pi / sqrt(b0). The error of a
/// does not reach the linear part of the prediction: when a changes, the travel changes by as much the other way.
/// Cost per sample: O(1) for a given model, no allocation.
class FreeRun {
 public:
  static constexpr int kDelay = kInterpolationReach;  ///< samples

  /// @param period  sampling time T > 0 [s].
  explicit FreeRun(double period);

  /// Changes the linear part if it is stable and the sampling can follow it: b1 > 0, b0 > 0, at most 32 steps per
  /// sample. The spring's force b0 d and the travel rate go on.
  /// @param damping_to_mass  b1 [1/s].  @param stiffness_to_mass  b0 [1/s^2].
  /// @return whether it is so; if false, the model stays as it was.
  bool trySetModel(double damping_to_mass, double stiffness_to_mass);

  /// Replaces the model's effects; the run goes on, their memories start at 0. Allocates.
  /// @throws std::invalid_argument  as requireUsable().
  void setEffects(const std::vector<ActiveEffect>& effects);

  /// Changes c_j [unit of the effect's coefficient].
  void setCoefficient(std::size_t j, double coefficient) { model_.effects[j].coefficient = coefficient; }

  bool hasModel() const { return steps_ != nullptr; }
  const StrutModel& model() const { return model_; }

  /// Takes in the next sample of an uninterrupted uniform series of w'' [m/s^2].
  /// @param time  of this sample since the start of the drive [s], for the laws that depend on it.
  /// @return the predicted body acceleration z'' at the sample kDelay before this one [m/s^2]; nothing before a model
  /// is set and 2 kDelay samples have come.
  std::optional<double> push(double unsprung_acceleration, double time = 0.0);

  /// @return true once the unknown initial travel has decayed to 1e-3 of itself.
  bool settled() const { return decayed_ >= std::log(1e3); }

  /// How often the run has left all bounds: the force of an effect was not usable (isUsable()), a prediction was not
  /// finite, or larger than a thousand times the largest w'' of the run. Effects can do that, whose coefficients
  /// trySetModel() does not judge. The run then starts anew.
  std::uint64_t runaways() const { return runaways_; }

  /// At the sample that the last prediction belongs to:
  double travel() const { return state_.travel; }           ///< d [m]; with effects less a / b0
  double travelRate() const { return state_.travel_rate; }  ///< v [m/s]
  /// f_j, one per effect, per unit of its coefficient.
  const double* effectForces() const { return forces_.data(); }

  /// Forgets travel and input, keeps the model, the mean of w'' and the memories that last: for a gap in the series.
  void reset();

 private:
  bool withEffects() const { return !model_.effects.empty(); }
  void advance(double time);
  double predict(double time);
  void countTravelFrom(double offset);
  void startAnew(double time);
  bool ranAway(double prediction);

  /// A mean with a memory.
  struct Mean {
    double value = 0.0, weight = 0.0;
    double memory = std::numeric_limits<double>::infinity();  // [samples]
    void add(double sample) {
      weight = std::min(weight, memory) + 1.0;
      value += (sample - value) / weight;
    }
  };

  double period_;
  StrutModel model_;
  const std::vector<WheelInterpolator>* steps_ = nullptr;  // of integration in a sample; none: no model yet
  double decay_rate_ = 0.0;                                // of the slowest free motion [1/s]
  StrutState state_;
  std::array<double, kMostEffects> forces_{};
  DelayLine input_{WheelInterpolator::kWidth};  // w''
  Mean mean_;                                   // of it
  double offset_ = 0.0;                         // travel is counted from where this constant holds it [m/s^2]
  double largest_ = 0.0;                        // |w''| of this run [m/s^2]
  double decayed_ = 0.0;                        // e-foldings since the start; 0: not running
  double last_time_ = 0.0;                      // of what was predicted [s]
  std::uint64_t runaways_ = 0;
};

}  // namespace suspension_health_monitor
