#include <cmath>
#include <complex>

#include "residual_series.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/periodogram.h"

namespace suspension_health_monitor {
namespace {

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
                                           const LinearStrut& strut, double noise_floor) {
  std::vector<std::size_t> sizes;
  for (const ComparedSegment& segment : segments) sizes.push_back(segment.size());
  const std::size_t length = Periodogram::lengthFor(sizes, series.natural_period);
  const std::size_t windows = Periodogram::windowsIn(sizes, length);
  if (windows < 2) return std::nullopt;
  Periodogram periodogram(length);
  SpectralSums sums(length / 2 + 1);
  Spectrum r, y, w;
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (std::size_t i = 0; i < Periodogram::windowsIn(segments[s].size(), length); ++i) {
      const std::size_t first = i * (length / 2);
      sums.add(periodogram.of(&series.residual[series.begins[s] + first], r),
               periodogram.of(&segments[s].measured[first], y),
               periodogram.of(&series.wheel[series.begins[s] + first], w));
    }

  ResidualSpectrum result;
  result.num_averages = std::max(1.0, Periodogram::kIndependent * static_cast<double>(windows));
  // gamma^2 of unrelated signals: P(gamma^2 > x) = (1 - x)^(n - 1).
  result.coherence_threshold = 1.0 - std::pow(0.05, 1.0 / std::max(1e-3, result.num_averages - 1.0));
  const double b1 = strut.damping_to_mass, b0 = strut.stiffness_to_mass;
  const double own = noise_floor * noise_floor / (1.0 + series.period * (b1 * b1 + b0) / (2.0 * b1));
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
