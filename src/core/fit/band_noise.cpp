#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/math/periodogram.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kParts = 4;           // of the drives, in each of which noise is the same
constexpr std::size_t kWindowsOfPart = 12;  // at least, for an average over them

/// Spectra of the residuals in each part of the drives.
struct PartSpectra {
  std::size_t length;  // of a window
  std::vector<std::vector<double>> parts;
  double averages;  // independent ones in each
  double unit;      // the sum over parts and frequencies that white noise of variance 1 has
};

/// Sums from the first frequency to each: of the weights g, and of g / S.
struct BandSums {
  std::vector<double> weight{0.0}, resistance{0.0};

  /// @param inverse  of S, summed over the parts.
  void add(double g, double inverse) {
    weight.push_back(weight.back() + g);
    resistance.push_back(resistance.back() + g * inverse);
  }

  /// @return the power of the largest white noise under the spectra in a band of frequencies, of all parts.
  double whiteIn(std::size_t first, std::size_t end) const {
    const double level = kParts * static_cast<double>(end - first) / (resistance[end] - resistance[first]);
    return kParts * level * (weight[end] - weight[first]);
  }
};

std::optional<PartSpectra> spectraOf(const Residuals& residuals, double natural_period) {
  const std::vector<std::size_t> sizes = sizesOf(residuals);
  const std::size_t length = Periodogram::lengthFor(sizes, natural_period, kParts * kWindowsOfPart);
  const std::size_t windows = Periodogram::windowsIn(sizes, length);
  if (windows < kParts * kWindowsOfPart) return std::nullopt;
  PartSpectra spectra{length, {kParts, std::vector<double>(length / 2, 0.0)}, 0.0, 0.0};
  spectra.averages = Periodogram::kIndependent * static_cast<double>(windows / kParts);
  Periodogram periodogram(length);
  Spectrum spectrum;
  std::size_t window = 0;
  Periodogram::forEachWindow(sizes, length, [&](std::size_t segment, std::size_t first) {
    std::vector<double>& power = spectra.parts[window++ * kParts / windows];
    periodogram.of(&residuals[segment][first], spectrum);
    for (std::size_t f = 1; f < length / 2; ++f) power[f] += std::norm(spectrum[f]);
  });
  spectra.unit = static_cast<double>(windows) * static_cast<double>(length / 2 - 1) * periodogram.taperPower();
  return spectra;
}

/// Noise that a sensor has filtered, as most do inside: white within a band, next to nothing beyond it, where an
/// interpolation (noise_floor.cpp) sees none. What a free run leaves is such noise if it is white within a band of its
/// own, and the same in every quarter of the drives; what a law leaves is strong near resonance and weak elsewhere, or
/// goes with a sweep.
///
/// White noise of both sensors has the spectrum n g(f), g = 1 + |G(f)|^2 for what comes through the model. The largest
/// that fits under the spectrum S of the residual in a band of m frequencies has n = m / sum(g / S), the harmonic mean
/// over frequencies and quarters, which is also what an interpolation of the band would leave (Kolmogorov). The band is
/// where n sum(g) is largest.
/// @param residuals  of a fit of the model.
/// @return its share of the residual's power; 0 if there are too few samples to tell.
double bandNoiseShare(const Residuals& residuals, double period, const StrutModel& model) {
  const double natural_period = 2.0 * M_PI / (std::sqrt(model.stiffness_to_mass) * period);
  const std::optional<PartSpectra> spectra = spectraOf(residuals, natural_period);
  if (!spectra) return 0.0;
  BandSums sums;
  double all = 0.0;
  for (std::size_t f = 1; f < spectra->length / 2; ++f) {
    const double frequency = static_cast<double>(f) / (static_cast<double>(spectra->length) * period);
    const double gain = transmissibility(model.damping_to_mass, model.stiffness_to_mass, frequency);
    double resistance = 0.0;
    for (const std::vector<double>& power : spectra->parts) {
      if (!(power[f] > 0.0)) return 0.0;
      resistance += 1.0 / power[f];
      all += power[f];
    }
    sums.add(1.0 + gain * gain, resistance);
  }
  // A sensor passes what the strut does: the band begins below its natural frequency and goes beyond twice that.
  const auto natural = static_cast<std::size_t>(static_cast<double>(spectra->length) / natural_period);
  double white = 0.0;
  for (std::size_t first = 0; first < natural; ++first)
    for (std::size_t end = 2 * natural + 1; end < sums.weight.size(); ++end)
      white = std::max(white, sums.whiteIn(first, end));
  // By this factor the mean of 1 / S is too large where S is an average over so many windows.
  const double scatter = spectra->averages / (spectra->averages - 1.0);
  // Of the residuals' power the spectra lack what is slower than the windows are long: an offset, and what wanders.
  const double shown = all / spectra->unit, whole = meanSquare(residuals);
  const double slow = whole > shown ? 1.0 - shown / whole : 0.0;
  return std::min(1.0, scatter * white / all) * (1.0 - slow);
}

}  // namespace

double floorOfResidual(double rmse, double noise_floor, const Residuals& residuals, double period,
                       const StrutModel& model) {
  const double in_band = rmse * std::sqrt(bandNoiseShare(residuals, period, model));
  return std::min(rmse, isStructured(rmse, in_band) ? noise_floor : std::max(noise_floor, in_band));
}

}  // namespace suspension_health_monitor
