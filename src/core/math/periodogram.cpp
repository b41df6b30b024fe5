#include "suspension_health_monitor/internal/math/periodogram.h"

#include <cmath>

namespace suspension_health_monitor {

constexpr double kWindowPeriods = 12.0;  // natural periods in a window, at least
constexpr std::size_t kShortestWindow = 32;

Periodogram::Periodogram(std::size_t length) : taper_(length), windowed_(length) {
  for (std::size_t i = 0; i < length; ++i) {
    taper_[i] = 0.5 - 0.5 * std::cos(2.0 * M_PI * static_cast<double>(i) / static_cast<double>(length));
    power_ += taper_[i] * taper_[i];
  }
  fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
}

std::size_t Periodogram::windowsIn(std::size_t samples, std::size_t length) {
  return samples < length ? 0 : 1 + (samples - length) / (length / 2);
}

std::size_t Periodogram::windowsIn(const std::vector<std::size_t>& stretches, std::size_t length) {
  std::size_t count = 0;
  for (const std::size_t samples : stretches) count += windowsIn(samples, length);
  return count;
}

std::size_t Periodogram::lengthFor(const std::vector<std::size_t>& stretches, double natural_period,
                                   std::size_t fewest_windows) {
  std::size_t length = kShortestWindow;
  while (static_cast<double>(length) < kWindowPeriods * natural_period &&
         windowsIn(stretches, 2 * length) >= fewest_windows)
    length *= 2;
  return length;
}

void Periodogram::of(const double* values, Spectrum& into) {
  double mean = 0.0;
  for (std::size_t i = 0; i < taper_.size(); ++i) mean += values[i];
  mean /= static_cast<double>(taper_.size());
  for (std::size_t i = 0; i < taper_.size(); ++i) windowed_[i] = taper_[i] * (values[i] - mean);
  fft_.fwd(into, windowed_);
}

}  // namespace suspension_health_monitor
