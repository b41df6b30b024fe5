#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "residual_series.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kWindowPeriods = 12.0;  // natural periods in a window, at least
constexpr std::size_t kShortestWindow = 32;
constexpr std::size_t kFewestWindows = 16;
constexpr double kIndependent = 1.0 / (1.0 + 2.0 / 36.0);  // of half overlapping Hann windows (Welch)

using Spectrum = std::vector<std::complex<double>>;

std::size_t windowsIn(std::size_t samples, std::size_t length) {
  return samples < length ? 0 : 1 + (samples - length) / (length / 2);
}

std::size_t windowsIn(const ResidualSeries& series, std::size_t length) {
  std::size_t count = 0;
  for (std::size_t s = 0; s + 1 < series.begins.size(); ++s)
    count += windowsIn(series.begins[s + 1] - series.begins[s], length);
  return count;
}

/// A power of two.
std::size_t windowLength(const ResidualSeries& series) {
  std::size_t length = kShortestWindow;
  while (static_cast<double>(length) < kWindowPeriods * series.natural_period) length *= 2;
  while (length > kShortestWindow && windowsIn(series, length) < kFewestWindows) length /= 2;
  return length;
}

/// Spectra of windows under the same taper.
class Periodogram {
 public:
  explicit Periodogram(std::size_t length) : taper_(length), windowed_(length) {
    for (std::size_t i = 0; i < length; ++i) {
      taper_[i] = 0.5 - 0.5 * std::cos(2.0 * kPi * static_cast<double>(i) / static_cast<double>(length));
      power_ += taper_[i] * taper_[i];
    }
    fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  }

  double taperPower() const { return power_; }

  const Spectrum& of(const double* values, Spectrum& into) {
    double mean = 0.0;
    for (std::size_t i = 0; i < taper_.size(); ++i) mean += values[i];
    mean /= static_cast<double>(taper_.size());
    for (std::size_t i = 0; i < taper_.size(); ++i) windowed_[i] = taper_[i] * (values[i] - mean);
    fft_.fwd(into, windowed_);
    return into;
  }

 private:
  std::vector<double> taper_, windowed_;
  double power_ = 0.0;
  Eigen::FFT<double> fft_;
};

/// Sums over all windows, by frequency.
struct SpectralSums {
  explicit SpectralSums(std::size_t count) : residual(count), measured(count), wheel(count), cross(count) {}

  void add(const Spectrum& r, const Spectrum& y, const Spectrum& w) {
    for (std::size_t i = 0; i < residual.size(); ++i) {
      residual[i] += std::norm(r[i]);
      measured[i] += std::norm(y[i]);
      wheel[i] += std::norm(w[i]);
      cross[i] += r[i] * std::conj(w[i]);
    }
  }

  std::vector<double> residual, measured, wheel;
  Spectrum cross;
};

}  // namespace

std::optional<ResidualSpectrum> spectrumOf(const ResidualSeries& series, const std::vector<ComparedSegment>& segments,
                                           const ExpectedNoise& noise) {
  const std::size_t length = windowLength(series);
  const std::size_t windows = windowsIn(series, length);
  if (windows < 2) return std::nullopt;
  Periodogram periodogram(length);
  SpectralSums sums(length / 2 + 1);
  Spectrum r, y, w;
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (std::size_t i = 0; i < windowsIn(segments[s].size(), length); ++i) {
      const std::size_t first = i * (length / 2);
      sums.add(periodogram.of(&series.residual[series.begins[s] + first], r),
               periodogram.of(&segments[s].measured[first], y),
               periodogram.of(&series.wheel[series.begins[s] + first], w));
    }

  ResidualSpectrum result;
  result.num_averages = std::max(1.0, kIndependent * static_cast<double>(windows));
  // gamma^2 of unrelated signals: P(gamma^2 > x) = (1 - x)^(n - 1).
  result.coherence_threshold = 1.0 - std::pow(0.05, 1.0 / std::max(1e-3, result.num_averages - 1.0));
  const double b1 = noise.damping_to_mass, b0 = noise.stiffness_to_mass;
  const double own = noise.floor * noise.floor / (1.0 + series.period * (b1 * b1 + b0) / (2.0 * b1));
  for (std::size_t i = 1; i <= length / 2; ++i) {
    const double sides = i == length / 2 ? 1.0 : 2.0;
    const double scale = sides * series.period / (periodogram.taperPower() * static_cast<double>(windows));
    const double frequency = static_cast<double>(i) / (static_cast<double>(length) * series.period);
    result.frequency.push_back(frequency);
    result.residual.push_back(scale * sums.residual[i]);
    result.measured.push_back(scale * sums.measured[i]);
    const double gain = transmissibility(b1, b0, frequency);
    result.noise.push_back(sides * series.period * own * (1.0 + gain * gain));
    const double power = sums.residual[i] * sums.wheel[i];
    result.coherence.push_back(power > 0.0 ? std::norm(sums.cross[i]) / power : 0.0);
  }
  return result;
}

}  // namespace suspension_health_monitor
