#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace suspension_health_monitor {

/// What the body's IMU measures besides z'', in the strut's frame: z up along the strut, x and y across it.
enum class BodyChannel {
  kAccelerationX,         ///< a_x [m/s^2], less its mean
  kAccelerationY,         ///< a_y [m/s^2], less its mean
  kAngularAccelerationX,  ///< w_x' [rad/s^2]
  kAngularAccelerationY   ///< w_y' [rad/s^2]
};
inline constexpr std::size_t kNumBodyChannels = 4;

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
  std::string finding;
  Apply apply;
  /// Size of coefficient i that changes the reading about as much as the residual does.
  double (*scale)(const ReadingSizes& sizes, std::size_t i);
  std::vector<BodyChannel> channels = {};  ///< without which the effect cannot be told
};

/// @return what coefficient i is called where all of a model's are listed: the effect's name, or NAME/COEFFICIENT if it
/// has several.
std::string nameOfCoefficient(const MeasurementEffect& effect, std::size_t i);

/// The built-in measurement effects, one record each in measurement_effect.cpp.
const std::vector<MeasurementEffect>& measurementEffects();

/// @return the effect of that name in `effects`.
/// @throws std::invalid_argument  naming the unknown name and the known ones.
const MeasurementEffect& findEffect(const std::vector<MeasurementEffect>& effects, std::string_view name);

}  // namespace suspension_health_monitor
