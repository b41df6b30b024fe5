#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace suspension_health_monitor {

using Spectrum = std::vector<std::complex<double>>;

/// Spectra of half overlapping windows under Hann's taper, for averages over them.
/// Source: Welch, IEEE Transactions on Audio and Electroacoustics 15 (1967), 70-73.
class Periodogram {
 public:
  static constexpr double kIndependent = 1.0 / (1.0 + 2.0 / 36.0);  ///< share of half overlapping windows that is

  explicit Periodogram(std::size_t length);

  /// @return how many windows fit into a stretch of so many samples, and into several.
  static std::size_t windowsIn(std::size_t samples, std::size_t length);
  static std::size_t windowsIn(const std::vector<std::size_t>& stretches, std::size_t length);

  /// @param natural_period  of the strut [samples].
  /// @return a power of two: twelve natural periods, or less if there would be too few windows.
  static std::size_t lengthFor(const std::vector<std::size_t>& stretches, double natural_period,
                               std::size_t fewest_windows = 16);

  double taperPower() const { return power_; }

  /// @param values  a window; its mean is taken off.
  const Spectrum& of(const double* values, Spectrum& into);

 private:
  std::vector<double> taper_, windowed_;
  double power_ = 0.0;
  Eigen::FFT<double> fft_;
};

}  // namespace suspension_health_monitor
