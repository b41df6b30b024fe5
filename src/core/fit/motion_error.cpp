#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "suspension_health_monitor/internal/fit/free_form.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

constexpr double kForgotten = 1.0 / 3.0;  // of the natural frequency: what is slower is not integrated
constexpr double kPadding = 6.0;          // times of the slowest frequency that is: ends do not reach each other,
                                          // or as many samples as there are: then no integral reaches further

MotionError motionError(const std::vector<double>& residual, double mean, double period, double stiffness_to_mass) {
  const std::size_t count = residual.size();
  const double slowest = kForgotten * std::sqrt(stiffness_to_mass);
  const double padding = std::min(kPadding / (slowest * period), static_cast<double>(count));
  std::size_t length = 2;
  while (length < count + static_cast<std::size_t>(padding)) length *= 2;
  std::vector<double> padded(length, 0.0);
  for (std::size_t k = 0; k < count; ++k) padded[k] = residual[k] - mean;
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> spectrum, once(length / 2 + 1), twice(length / 2 + 1);
  fft.fwd(spectrum, padded);
  for (std::size_t i = 1; i <= length / 2; ++i) {
    const double omega = 2.0 * M_PI * static_cast<double>(i) / (static_cast<double>(length) * period);
    const double kept = 1.0 / (1.0 + square(square(slowest / omega)));
    once[i] = spectrum[i] * kept / std::complex<double>(0.0, omega);
    twice[i] = -spectrum[i] * kept / square(omega);
  }
  once[length / 2] = 0.0;  // imaginary, which a real signal cannot have there
  MotionError error;
  fft.inv(error.travel_rate, once);
  fft.inv(error.travel, twice);
  error.travel_rate.resize(count);
  error.travel.resize(count);
  return error;
}

}  // namespace suspension_health_monitor
