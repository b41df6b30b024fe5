#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace suspension_health_monitor {

/// Something that is wrong with the reading of the body's sensor, not with the strut: acts on the predicted z''.
/// Never to be called a damper.
struct MeasurementEffect {
  /// Changes a predicted series in place.
  /// @param coefficient  c.  @param period  sampling time [s].
  using Apply = void (*)(double coefficient, double period, std::vector<double>& predicted);

  std::string name;
  std::string law;  ///< what is read instead of y
  std::string unit;
  std::string finding;
  Apply apply;
  /// Size of c that changes the reading about as much as `residual` [m/s^2] does, for a signal of rms `y` and period T.
  double (*scale)(double residual, double y, double period);
};

/// The built-in measurement effects, one record each in measurement_effect.cpp.
const std::vector<MeasurementEffect>& measurementEffects();

/// @return the effect of that name in `effects`.
/// @throws std::invalid_argument  naming the unknown name and the known ones.
const MeasurementEffect& findEffect(const std::vector<MeasurementEffect>& effects, std::string_view name);

}  // namespace suspension_health_monitor
