#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {

/// An effect in use: with its coefficient and its shapes (SI).
struct ActiveEffect {
  ForceEffect effect;
  double coefficient = 0.0;
  std::vector<double> shapes;  ///< one per effect.shapes

  /// @return c f [m/s^2].
  double force(const StrutMotion& motion) const { return coefficient * effect.force(motion, shapes.data()); }

  /// @return the rate of the effect's memory; 0 if it has none.
  Memory memoryRate(const StrutMotion& motion) const {
    return effect.memory_rate ? effect.memory_rate(motion, shapes.data()) : Memory();
  }
};

/// A fault of the measurement, with its size.
struct ActiveMeasurementEffect {
  MeasurementEffect effect;
  std::vector<double> coefficients;  ///< one per effect.coefficients
};

inline constexpr std::size_t kMostEffects = 8;  ///< in one model

/// The linear part of a strut.
struct LinearStrut {
  double damping_to_mass = 0.0;    ///< b1 [1/s]
  double stiffness_to_mass = 0.0;  ///< b0 [1/s^2]
};

/// The strut as it is modelled: z'' = b1 v + b0 d + sum_j c_j f_j, and how its acceleration is read.
struct StrutModel {
  double damping_to_mass = 0.0;    ///< b1 [1/s]
  double stiffness_to_mass = 0.0;  ///< b0 [1/s^2]
  std::vector<ActiveEffect> effects;
  std::vector<ActiveMeasurementEffect> reading;
  /// false: it leaves more than noise of the drives that it is from, so its b1 and b0 are those of these drives only.
  bool is_complete = true;

  LinearStrut linearPart() const { return {damping_to_mass, stiffness_to_mass}; }

  /// @return true if b1 > 0 and b0 > 0; not for NaN.
  bool isDampedSpring() const { return damping_to_mass > 0.0 && stiffness_to_mass > 0.0; }

  /// @param memory  one state per effect, those without memory included.
  /// @return z'' [m/s^2].
  double force(double travel, double travel_rate, double time, const Memory* memory) const {
    double sum = damping_to_mass * travel_rate + stiffness_to_mass * travel;
    for (std::size_t j = 0; j < effects.size(); ++j) sum += effects[j].force({travel, travel_rate, time, memory[j]});
    return sum;
  }

  /// Turns a series of z'' in place into what the faulty sensor reads.
  /// @param body  of the same samples.  @param period  sampling time T [s].
  void read(const BodyChannels& body, double period, std::vector<double>& series) const {
    for (const auto& [fault, coefficients] : reading) fault.apply(coefficients.data(), body, period, series);
  }
};

/// Why a fit gave no model that can be named.
enum class FitFailure {
  kNone,
  kRunsAway,                 ///< no model near the start is stable on these drives
  kNeverActs,                ///< an effect of the model does nothing here
  kNotSolved,                ///< the solver came to no end
  kNoSpring,                 ///< b0 is not above 0
  kTooFast,                  ///< too fast for the sampling: more than 32 integration steps per sample
  kWrongSign,                ///< its coefficient is not above 0, as physics has it
  kShapeAtEnd,               ///< a shape is at the end of its range, where the law is another one
  kConfoundedWithFrequency,  ///< what seems to change with time changes as well with the frequency of the motion
  kWanders,                  ///< the offset that it makes is not larger than what wanders beside it
};

/// One number of a model as files and tables list it.
struct ModelNumber {
  enum class Kind { kStrut, kCoefficient, kShape };

  Kind kind = Kind::kStrut;
  std::string name;    ///< damping_to_mass, bump_stop (its coefficient), bump_stop/g (a shape), mount_tilt/c_x
  std::string effect;  ///< bump_stop; empty for those of the linear strut
  std::string symbol;  ///< b1, b0, c, or what the law calls it
  std::string unit;
  double value = 0.0;  ///< SI
};

/// @return b1, b0, coefficient and shapes effect by effect, then the coefficients of the reading's faults: the order in
/// which a fit has standard deviations.
std::vector<ModelNumber> numbersOf(const StrutModel& model);

/// @return the same numbers, to be changed in place; valid as long as no effect is added or taken out.
std::vector<double*> valuesOf(StrutModel& model);

/// @return the names of its effects, then of its reading's faults.
std::vector<std::string> effectNames(const StrutModel& model);

}  // namespace suspension_health_monitor
