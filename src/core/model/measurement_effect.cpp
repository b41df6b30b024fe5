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

std::vector<MeasurementEffect> makeMeasurementEffects() {
  return {
      {"clock_offset", "y(t - c)", "s", "IMU clocks are not synchronised", delay,
       [](double residual, double y, double period) { return period * residual / y; }},
      {"accelerometer_bias", "y + c", "m/s^2", "offset of a sensor",
       [](double c, double, std::vector<double>& predicted) {
         for (double& y : predicted) y += c;
       },
       [](double residual, double, double) { return residual; }},
      {"scale_error", "(1 + c) y", "-", "gain of a sensor",
       [](double c, double, std::vector<double>& predicted) {
         for (double& y : predicted) y *= 1.0 + c;
       },
       [](double residual, double y, double) { return residual / y; }},
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
