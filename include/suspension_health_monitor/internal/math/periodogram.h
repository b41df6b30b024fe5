#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <cstddef>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace suspension_health_monitor {

using Spectrum = std::vector<std::complex<double>>;

/// @return of segments, whatever they hold: how many samples each has.
template <class Segments>
std::vector<std::size_t> sizesOf(const Segments& segments) {
  std::vector<std::size_t> sizes;
  for (const auto& segment : segments) sizes.push_back(segment.size());
  return sizes;
}

/// Spectra of half overlapping windows under Hann's taper, for averages over them.
/// Source: Welch, IEEE Transactions on Audio and Electroacoustics 15 (1967), 70-73.
class Periodogram {
 public:
  static constexpr double kWindowPeriods = 12.0;  ///< natural periods in a window, at least
  static constexpr std::size_t kShortestWindow = 32;
  static constexpr double kIndependent = 1.0 / (1.0 + 2.0 / 36.0);  ///< share of half overlapping windows that is

  explicit Periodogram(std::size_t length) : taper_(length), windowed_(length) {
    for (std::size_t i = 0; i < length; ++i) {
      taper_[i] = 0.5 - 0.5 * std::cos(2.0 * M_PI * static_cast<double>(i) / static_cast<double>(length));
      power_ += taper_[i] * taper_[i];
    }
    fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  }

  /// @return how many windows fit into a stretch of so many samples, and into several.
  static std::size_t windowsIn(std::size_t samples, std::size_t length) {
    return samples < length ? 0 : 1 + (samples - length) / (length / 2);
  }
  static std::size_t windowsIn(const std::vector<std::size_t>& stretches, std::size_t length) {
    std::size_t count = 0;
    for (const std::size_t samples : stretches) count += windowsIn(samples, length);
    return count;
  }

  /// Calls take(stretch, first) for every window of several stretches, `first` being its first sample.
  template <class Take>
  static void forEachWindow(const std::vector<std::size_t>& stretches, std::size_t length, const Take& take) {
    for (std::size_t s = 0; s < stretches.size(); ++s)
      for (std::size_t i = 0; i < windowsIn(stretches[s], length); ++i) take(s, i * (length / 2));
  }

  /// @param natural_period  of the strut [samples].
  /// @return a power of two: twelve natural periods, or less if there would be too few windows.
  static std::size_t lengthFor(const std::vector<std::size_t>& stretches, double natural_period,
                               std::size_t fewest_windows = 16) {
    std::size_t length = kShortestWindow;
    while (static_cast<double>(length) < kWindowPeriods * natural_period &&
           windowsIn(stretches, 2 * length) >= fewest_windows)
      length *= 2;
    return length;
  }

  double taperPower() const { return power_; }

  /// @param values  a window; its mean is taken off.
  void of(const double* values, Spectrum& into) {
    double mean = 0.0;
    for (std::size_t i = 0; i < taper_.size(); ++i) mean += values[i];
    mean /= static_cast<double>(taper_.size());
    for (std::size_t i = 0; i < taper_.size(); ++i) windowed_[i] = taper_[i] * (values[i] - mean);
    fft_.fwd(into, windowed_);
  }

 private:
  std::vector<double> taper_, windowed_;
  double power_ = 0.0;
  Eigen::FFT<double> fft_;
};

}  // namespace suspension_health_monitor
