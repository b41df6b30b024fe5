#include "suspension_health_monitor/internal/identification/horizon_selection.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

// omega h / 2 at which sinc^2 is sqrt(1/2).
constexpr double kFilterHalfPower = 1.0019063576966072;

constexpr double kLargest = 1e12;  // [1/s], [1/s^2]: their squares stay numbers

// With x = omega^2 / b0 and c = b1^2 / b0,  |G|^2 = (1 + c x) / ((1 - x)^2 + c x).
double gainSquared(double x, double c) { return (1.0 + c * x) / ((1.0 - x) * (1.0 - x) + c * x); }

// @return omega^2 / b0 above the resonance where |G|^2 is half its maximum: the larger root of a quadratic.
double halfPower(double c) {
  const double resonance = 2.0 / (std::sqrt(1.0 + 2.0 * c) + 1.0);
  const double level = 0.5 * gainSquared(resonance, c);
  const double half_sum = (1.0 - 0.5 * c) + 0.5 * c / level;
  return half_sum + std::sqrt(half_sum * half_sum + (1.0 - level) / level);
}

}  // namespace

double transmissibility(double damping_to_mass, double stiffness_to_mass, double frequency_hz) {
  const std::complex<double> s(0.0, 2.0 * M_PI * frequency_hz);
  const std::complex<double> force = damping_to_mass * s + stiffness_to_mass;
  return std::abs(force / (s * s + force));
}

double noiseOfBothSensors(double damping_to_mass, double stiffness_to_mass, double period, double wheel_to_body) {
  return 1.0 +
         wheel_to_body * period * (damping_to_mass * damping_to_mass + stiffness_to_mass) / (2.0 * damping_to_mass);
}

double integralFilterMagnitude(double horizon, double frequency_hz) {
  const double x = M_PI * frequency_hz * horizon;
  const double sinc = x == 0.0 ? 1.0 : std::sin(x) / x;
  return sinc * sinc;
}

double bandwidth(double damping_to_mass, double stiffness_to_mass) {
  requireAboveZero("damping_to_mass", damping_to_mass, "1/s", kLargest);
  requireAboveZero("stiffness_to_mass", stiffness_to_mass, "1/s^2", kLargest);
  return std::sqrt(stiffness_to_mass * halfPower(damping_to_mass / stiffness_to_mass * damping_to_mass));
}

double proposeHorizon(double damping_to_mass, double stiffness_to_mass) {
  return 2.0 * kFilterHalfPower / bandwidth(damping_to_mass, stiffness_to_mass);
}

int horizonSamples(double horizon, double period) {
  requireAboveZero("integration_horizon", horizon, "s", kLargest);
  requireAboveZero("sample_period", period, "s", kLargest);
  const double samples = std::min(horizon / period, 1.0 * std::numeric_limits<int>::max());
  return std::max(1, static_cast<int>(std::lround(samples)));
}

}  // namespace suspension_health_monitor
