#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/signal/filters.h"

namespace suspension_health_monitor {
namespace {

/// Weight of a sample at a distance of x samples: a sinc in a Hann window. In closed form, so that a fit can
/// differentiate by the delay; good to 3e-3 up to 3/4 of Nyquist's frequency, where a rough road still shakes a car.
double weightAt(double x) {
  if (std::abs(x) >= kInterpolationReach) return 0.0;
  const double window = std::cos(M_PI * x / (2.0 * kInterpolationReach));
  return x == 0.0 ? 1.0 : window * window * std::sin(M_PI * x) / (M_PI * x);
}

/// y(t - tau); beyond its ends the series goes on as its mirror image turned over.
void delay(double tau, double period, std::vector<double>& predicted) {
  const double shift = std::floor(-tau / period), fraction = -tau / period - shift;  // in samples
  std::array<double, 2 * kInterpolationReach> weights{};
  double sum = 0.0;
  for (int i = 0; i < 2 * kInterpolationReach; ++i)
    sum += weights[i] = weightAt(i + 1 - kInterpolationReach - fraction);
  for (double& weight : weights) weight /= sum;

  const std::vector<double> y = predicted;
  const auto last = static_cast<long>(y.size()) - 1;
  const auto at = [&](long k) {
    const long inside = std::clamp(k < 0 ? -k : k > last ? 2 * last - k : k, 0L, last);
    const double value = y[inside];
    return k < 0 ? 2.0 * y.front() - value : k > last ? 2.0 * y.back() - value : value;
  };
  // A delay beyond the series' length has no meaning, but a solver may try it.
  const auto whole =
      static_cast<long>(std::clamp(shift, -2.0 * static_cast<double>(last), 2.0 * static_cast<double>(last)));
  for (long k = 0; k <= last; ++k) {
    const long first = k + whole + 1 - kInterpolationReach;
    double value = 0.0;
    for (long i = 0; i < 2 * kInterpolationReach; ++i) value += weights[i] * at(first + i);
    predicted[k] = value;
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

}  // namespace

const std::vector<MeasurementEffect>& measurementEffects() {
  using Sizes = ReadingSizes;
  using C = BodyChannel;
  using Series = std::vector<double>;
  static const std::vector<MeasurementEffect> effects{
      {"clock_offset",
       "y(t - c)",
       {{"coefficient", "s"}},
       "IMU clocks are not synchronised",
       "A fault of the sensors, not of the strut: synchronise their clocks, or take the delay out of the stamps.",
       [](const double* c, const BodyChannels&, double period, Series& predicted) { delay(*c, period, predicted); },
       [](const Sizes& sizes, std::size_t) { return sizes.period * sizes.residual / sizes.y; }},
      {"accelerometer_bias",
       "y + c",
       {{"coefficient", "m/s^2"}},
       "offset of a sensor",
       "A fault of the sensor, not of the strut: let it warm up, and calibrate it at rest; a few hundredths of m/s^2 "
       "in every strut may be a body that leans and turns.",
       [](const double* c, const BodyChannels&, double, Series& predicted) {
         for (double& y : predicted) y += *c;
       },
       [](const Sizes& sizes, std::size_t) { return sizes.residual; }},
      {"scale_error",
       "(1 + c) y",
       {{"coefficient", "-"}},
       "gain of a sensor",
       "A fault of the sensor, not of the strut: check range and unit in its driver, and calibrate it upright and "
       "upside down.",
       // What is off in the gain is off in gravity, too, which makes an offset of it: that tells a gain from an offset.
       [](const double* c, const BodyChannels& body, double, Series& predicted) {
         for (double& y : predicted) y *= 1.0 + *c;
         leak(*c, body, C::kGravity, predicted);
       },
       [](const Sizes& sizes, std::size_t) { return sizes.residual / sizes.y; }},
      // Small angles: turned about y by c_x, the sensor's z axis sees c_x of what happens along x, and less of gravity.
      {"mount_tilt",
       "y + c_x a_x + c_y a_y",
       {{"c_x", "rad"}, {"c_y", "rad"}},
       "IMU of the body is not level",
       "A fault of the sensor's mount, not of the strut: level the body's IMU, or tell its mount by target_frame.",
       [](const double* c, const BodyChannels& body, double, Series& predicted) {
         for (const auto& [angle, channel] : {std::pair(c[0], C::kAccelerationX), std::pair(c[1], C::kAccelerationY)}) {
           leak(angle, body, channel, predicted);
           if (!body[static_cast<std::size_t>(channel)].empty())
             leak(-0.5 * angle * angle, body, C::kGravity, predicted);
         }
       },
       [](const Sizes& sizes, std::size_t i) {
         return leakScale(sizes, i == 0 ? C::kAccelerationX : C::kAccelerationY);
       },
       {C::kAccelerationX, C::kAccelerationY}},
      // The z component of w' x r, r from the top of the strut to the sensor.
      {"lever_arm",
       "y + r_y w_x' - r_x w_y'",
       {{"r_x", "m"}, {"r_y", "m"}},
       "IMU of the body is away from the strut top",
       "A fault of the sensor's place, not of the strut: move the body's IMU to the top of the strut, or tell its "
       "position in a vehicle file.",
       [](const double* r, const BodyChannels& body, double, Series& predicted) {
         leak(-r[0], body, C::kAngularAccelerationY, predicted);
         leak(r[1], body, C::kAngularAccelerationX, predicted);
       },
       [](const Sizes& sizes, std::size_t i) {
         return leakScale(sizes, i == 0 ? C::kAngularAccelerationY : C::kAngularAccelerationX);
       },
       {C::kAngularAccelerationX, C::kAngularAccelerationY}},
  };
  return effects;
}

std::string nameOfCoefficient(const MeasurementEffect& effect, std::size_t i) {
  return effect.coefficients.size() == 1 ? effect.name : effect.name + '/' + effect.coefficients[i].name;
}

}  // namespace suspension_health_monitor
