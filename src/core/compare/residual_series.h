#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/math/periodogram.h"

namespace suspension_health_monitor {

/// All segments one after the other, one entry per sample, the means of residual and missing force taken off.
struct ResidualSeries {
  Eigen::VectorXd residual, missing, travel, rate, wheel;
  std::vector<std::size_t> begins{0};                  ///< of the segments, and the end of the last one
  double period = 0.0;                                 ///< T [s]
  double natural_period = 0.0;                         ///< of the strut, in samples
  double offset = 0.0;                                 ///< mean residual [m/s^2]
  double residual_memory = 1.0, missing_memory = 1.0;  ///< samples per independent one, >= 1

  std::size_t size() const { return residual.size(); }
};

/// @param segments  those of the series.
/// @return nothing if not even two windows fit into the segments.
inline std::optional<ResidualSpectrum> spectrumOf(const ResidualSeries& series,
                                                  const std::vector<ComparedSegment>& segments,
                                                  const LinearStrut& strut, const NoiseFloor& noise_floor) {
  const std::vector<std::size_t> sizes = sizesOf(segments);
  const std::size_t length = Periodogram::lengthFor(sizes, series.natural_period);
  const std::size_t windows = Periodogram::windowsIn(sizes, length);
  if (windows < 2) return std::nullopt;
  Periodogram periodogram(length);
  std::vector<double> residual(length / 2 + 1), measured = residual, wheel = residual;  // sums over all windows
  Spectrum r, y, w, cross(length / 2 + 1);
  Periodogram::forEachWindow(sizes, length, [&](std::size_t segment, std::size_t first) {
    const std::size_t in_series = series.begins[segment] + first;
    periodogram.of(&series.residual[in_series], r);
    periodogram.of(&segments[segment].measured[first], y);
    periodogram.of(&series.wheel[in_series], w);
    for (std::size_t i = 0; i < cross.size(); ++i) {
      residual[i] += std::norm(r[i]);
      measured[i] += std::norm(y[i]);
      wheel[i] += std::norm(w[i]);
      cross[i] += r[i] * std::conj(w[i]);
    }
  });

  ResidualSpectrum result;
  result.num_averages = std::max(1.0, Periodogram::kIndependent * static_cast<double>(windows));
  // gamma^2 of unrelated signals: P(gamma^2 > x) = (1 - x)^(n - 1).
  result.coherence_threshold = 1.0 - std::pow(0.05, 1.0 / std::max(1e-3, result.num_averages - 1.0));
  const double b1 = strut.damping_to_mass, b0 = strut.stiffness_to_mass;
  const double loud = noise_floor.wheel_to_body;
  const double own = square(noise_floor.rms) / noiseOfBothSensors(b1, b0, series.period, loud);
  for (std::size_t i = 1; i <= length / 2; ++i) {
    const double sides = i == length / 2 ? 1.0 : 2.0;
    const double scale = sides * series.period / (periodogram.taperPower() * static_cast<double>(windows));
    const double frequency = static_cast<double>(i) / (static_cast<double>(length) * series.period);
    result.frequency.push_back(frequency);
    result.residual.push_back(scale * residual[i]);
    result.measured.push_back(scale * measured[i]);
    const double gain = transmissibility(b1, b0, frequency);
    result.noise.push_back(sides * series.period * own * (1.0 + loud * gain * gain));
    const double power = residual[i] * wheel[i];
    result.coherence.push_back(power > 0.0 ? std::norm(cross[i]) / power : 0.0);
  }
  return result;
}

}  // namespace suspension_health_monitor
