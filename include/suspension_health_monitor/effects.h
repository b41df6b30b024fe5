#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace suspension_health_monitor {

/// The state of an effect, or its rate. Most laws have one number, s, and may take and return it as a double.
struct Memory {
  double s = 0.0;
  double second = 0.0;  ///< of a law that has two, such as the speed of a mass

  Memory(double first = 0.0, double other = 0.0) : s(first), second(other) {}
  operator double() const { return s; }
};

/// What an effect may depend on, at one instant.
struct StrutMotion {
  double travel = 0.0;             ///< d [m], compression positive
  double travel_rate = 0.0;        ///< v [m/s]
  double time = 0.0;               ///< t [s] since the start of the drive; offline on from drive to drive
  Memory memory = {};              ///< the effect's own state, 0 at the start
  double body_acceleration = 0.0;  ///< z'' [m/s^2]; for memory rates only, as forces make it
};

/// What a shape parameter is measured in: the search proposes values as multiples of what the drive shows.
enum class ShapeScale {
  kNone,        ///< a plain number
  kTravel,      ///< of the drive's rms travel [m]
  kTravelRate,  ///< of its rms travel rate [m/s]
  kTime,        ///< of the strut's natural time 1/sqrt(b0) [s]
  kFrequency    ///< of its natural frequency sqrt(b0)/(2 pi) [Hz]
};

/// A number inside a law that does not enter linearly, such as the gap of a stop. Fitted offline, fixed online.
struct ShapeParameter {
  std::string name, unit;
  ShapeScale scale = ShapeScale::kNone;
  double min = 0.0, max = 0.0;  ///< in units of the scale, 0 < min < max
  /// The law stays itself below min, as friction that turns at once, or above max. At any other end of its range a law
  /// becomes one that the model has already, or a neighbour in the catalogue: a shape that a fit takes there names
  /// nothing.
  bool open_below = false, open_above = false;
};

/// A physical effect that the linear strut lacks: an additional force on the body per unit mass,
///   z'' = b1 v + b0 d + c f(d, v, t, shapes, s),   s' = g(d, v, t, shapes, s).
/// A law of your own is one more record; searches call its functions on several threads at once.
struct ForceEffect {
  using Law = std::function<double(const StrutMotion&, const double* shapes)>;
  using MemoryLaw = std::function<Memory(const StrutMotion&, const double* shapes)>;

  std::string name;
  std::string law;      ///< the formula for people, c included
  std::string unit;     ///< of the coefficient c
  std::string finding;  ///< what a workshop would find
  std::string advice;   ///< in a sentence: whether that is design or wear, and what to check
  Law force;            ///< f, per unit of c; shapes in SI
  std::vector<ShapeParameter> shapes = {};
  MemoryLaw memory_rate = {};  ///< g [unit of s per second]; empty: no memory
  bool positive = false;       ///< c > 0 by physics: what dissipates or pushes back cannot do the opposite
  /// The memory, one number, lasts as heat does: over a gap it goes on by g at rest, linear in s; others begin anew.
  bool lasts = false;
};

/// What the body's IMU measures besides the changing part of z'', in the strut's frame: z up along the strut, x and y
/// across it.
enum class BodyChannel {
  kAccelerationX,         ///< a_x [m/s^2], less its mean
  kAccelerationY,         ///< a_y [m/s^2], less its mean
  kAngularAccelerationX,  ///< w_x' [rad/s^2]
  kAngularAccelerationY,  ///< w_y' [rad/s^2]
  kGravity                ///< what the readings have of gravity, the mean of w'' [m/s^2], the same at every sample
};
inline constexpr std::size_t kNumBodyChannels = 5;

/// By BodyChannel one value per sample; empty where the channel is not known.
using BodyChannels = std::array<std::vector<double>, kNumBodyChannels>;

/// rms values of a drive that tell which size of a coefficient matters.
struct ReadingSizes {
  double residual = 0.0;  ///< what a model leaves [m/s^2]
  double y = 0.0;         ///< of the measured z'' [m/s^2]
  double period = 0.0;    ///< T [s]
  std::array<double, kNumBodyChannels> body{};
};

/// Something that is wrong with the reading of the body's sensor, not with the strut: acts on the predicted z''.
/// Never to be called a damper.
struct MeasurementEffect {
  struct Coefficient {
    std::string name;  ///< "coefficient" if there is only one
    std::string unit;
  };

  /// Changes a predicted series in place.
  /// @param c  one value per coefficient.  @param body  of the same samples.  @param period  sampling time [s].
  using Apply = void (*)(const double* c, const BodyChannels& body, double period, std::vector<double>& predicted);

  std::string name;
  std::string law;  ///< what is read instead of y
  std::vector<Coefficient> coefficients;
  std::string finding, advice;
  Apply apply;
  /// Size of coefficient i that changes the reading about as much as the residual does.
  double (*scale)(const ReadingSizes& sizes, std::size_t i);
  std::vector<BodyChannel> channels = {};  ///< without which the effect cannot be told
};

/// The built-in force effects, one record each in src/core/model/effect_catalogue.cpp: everything else (fits, settings,
/// the simulator, messages, tables) iterates over this list. See doc/add_an_effect.md.
const std::vector<ForceEffect>& forceEffects();

/// The built-in measurement effects, one record each in src/core/model/measurement_effect.cpp.
const std::vector<MeasurementEffect>& measurementEffects();

/// What may be missing from a model, and what one may be made of: the catalogue's records and the user's own laws.
struct EffectLibrary {
  /// An effect as tables list it.
  struct Description {
    using NameAndUnit = std::pair<std::string, std::string>;

    std::string name, law;
    std::string kind;  ///< force, or reading: a fault of the measurement
    std::string finding, advice;
    std::vector<NameAndUnit> coefficients, shapes;
  };

  std::vector<ForceEffect> forces;
  std::vector<MeasurementEffect> readings;

  /// @return the forces, then the faults of the measurement.
  std::vector<Description> describe() const;
};

/// @return the whole catalogue.
EffectLibrary builtInEffects();

/// @return the effect of that name in `effects`.
/// @throws std::invalid_argument  naming the unknown name and the known ones.
const ForceEffect& findEffect(const std::vector<ForceEffect>& effects, std::string_view name);
const MeasurementEffect& findEffect(const std::vector<MeasurementEffect>& effects, std::string_view name);

/// @return what coefficient i is called where all of a model's are listed: the effect's name, or NAME/COEFFICIENT if it
/// has several.
std::string nameOfCoefficient(const MeasurementEffect& effect, std::size_t i);

}  // namespace suspension_health_monitor
