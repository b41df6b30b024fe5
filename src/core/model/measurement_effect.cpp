#include "suspension_health_monitor/model/measurement_effect.h"

#include <algorithm>
#include <cmath>

#include "find_by_name.h"

namespace suspension_health_monitor {
namespace {

// y(t - tau) by the parabola through three neighbours: tau is a fraction of a sample, or a few of them.
void delay(double tau, double period, std::vector<double>& predicted) {
  const std::vector<double> y = predicted;
  const auto last = static_cast<double>(y.size()) - 2.0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double at = static_cast<double>(k) - tau / period;
    const double middle = std::clamp(std::round(at), 1.0, last);
    const auto i = static_cast<std::size_t>(middle);
    const double s = at - middle;
    predicted[k] = y[i] + s * ((y[i + 1] - y[i - 1]) / 2 + s * (y[i + 1] - 2 * y[i] + y[i - 1]) / 2);
  }
}

/// Adds what leaks in of one channel, if it is known.
void leak(double c, const BodyChannels& body, BodyChannel channel, std::vector<double>& predicted) {
  const std::vector<double>& values = body[static_cast<std::size_t>(channel)];
  for (std::size_t k = 0; k < values.size(); ++k) predicted[k] += c * values[k];
}

/// Size of a coefficient by which a channel leaks in.
double leakScale(const ReadingSizes& sizes, BodyChannel channel) {
  return sizes.residual / sizes.body[static_cast<std::size_t>(channel)];
}

std::vector<MeasurementEffect> makeMeasurementEffects() {
  using Sizes = ReadingSizes;
  using C = BodyChannel;
  using Series = std::vector<double>;
  return {
      {"clock_offset", "y(t - c)", {{"coefficient", "s"}}, "IMU clocks are not synchronised",
       [](const double* c, const BodyChannels&, double period, Series& predicted) { delay(*c, period, predicted); },
       [](const Sizes& sizes, std::size_t) { return sizes.period * sizes.residual / sizes.y; }},
      {"accelerometer_bias", "y + c", {{"coefficient", "m/s^2"}}, "offset of a sensor",
       [](const double* c, const BodyChannels&, double, Series& predicted) {
         for (double& y : predicted) y += *c;
       },
       [](const Sizes& sizes, std::size_t) { return sizes.residual; }},
      {"scale_error", "(1 + c) y", {{"coefficient", "-"}}, "gain of a sensor",
       [](const double* c, const BodyChannels&, double, Series& predicted) {
         for (double& y : predicted) y *= 1.0 + *c;
       },
       [](const Sizes& sizes, std::size_t) { return sizes.residual / sizes.y; }},
      // Small angles: turned about y by c_x, the sensor's z axis sees c_x of what happens along x.
      {"mount_tilt", "y + c_x a_x + c_y a_y", {{"c_x", "rad"}, {"c_y", "rad"}}, "IMU of the body is not level",
       [](const double* c, const BodyChannels& body, double, Series& predicted) {
         leak(c[0], body, C::kAccelerationX, predicted);
         leak(c[1], body, C::kAccelerationY, predicted);
       },
       [](const Sizes& sizes, std::size_t i) { return leakScale(sizes, i == 0 ? C::kAccelerationX : C::kAccelerationY); },
       {C::kAccelerationX, C::kAccelerationY}},
      // The z component of w' x r, r from the top of the strut to the sensor.
      {"lever_arm", "y + r_y w_x' - r_x w_y'", {{"r_x", "m"}, {"r_y", "m"}}, "IMU of the body is away from the strut top",
       [](const double* r, const BodyChannels& body, double, Series& predicted) {
         leak(-r[0], body, C::kAngularAccelerationY, predicted);
         leak(r[1], body, C::kAngularAccelerationX, predicted);
       },
       [](const Sizes& sizes, std::size_t i) {
         return leakScale(sizes, i == 0 ? C::kAngularAccelerationY : C::kAngularAccelerationX);
       },
       {C::kAngularAccelerationX, C::kAngularAccelerationY}},
  };
}

}  // namespace

const std::vector<MeasurementEffect>& measurementEffects() {
  static const std::vector<MeasurementEffect> effects = makeMeasurementEffects();
  return effects;
}

const MeasurementEffect& findEffect(const std::vector<MeasurementEffect>& effects, std::string_view name) {
  return findByName(effects, name);
}

}  // namespace suspension_health_monitor
