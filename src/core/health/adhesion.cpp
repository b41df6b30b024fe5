#include <algorithm>
#include <complex>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/health/inspection.h"

namespace suspension_health_monitor {

constexpr double kPlateAmplitude = 0.003;  // [m]: 6 mm from top to bottom
constexpr double kPlateHighest = 25.0;     // [Hz]
constexpr int kPlateFrequencies = 250;     // 0.1 Hz apart: a twentieth of the width of a wheel hop that is well damped

double adhesionAt(double frequency, const QuarterCarRatios& car) {
  const std::complex<double> s(0.0, 2.0 * M_PI * frequency);
  const std::complex<double> strut = car.damping_to_mass * s + car.stiffness_to_mass;
  const std::complex<double> inertia = s * s * (strut / (s * s + strut) + car.mass_ratio);
  const double swing = std::abs(car.tyre_to_mass * inertia / (car.tyre_to_mass + inertia)) * kPlateAmplitude;
  return std::max(0.0, 1.0 - swing / ((1.0 + car.mass_ratio) * kStandardGravity));
}

double leastAdhesion(const QuarterCarRatios& car) {
  double least = 1.0;
  for (int i = 1; i <= kPlateFrequencies; ++i)
    least = std::min(least, adhesionAt(kPlateHighest * i / kPlateFrequencies, car));
  return least;
}

}  // namespace suspension_health_monitor
