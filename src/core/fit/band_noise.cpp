#include "suspension_health_monitor/internal/fit/band_noise.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/periodogram.h"
#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kFewestAverages = 8.0;

/// Sums from the first frequency to each: of the weights g, and of g / S.
struct BandSums {
  std::vector<double> weight{0.0}, resistance{0.0};

  void add(double g, double power) {
    weight.push_back(weight.back() + g);
    resistance.push_back(resistance.back() + g / power);
  }

  /// @return the power of the largest white noise under the spectrum in a band of frequencies.
  double whiteIn(std::size_t first, std::size_t end) const {
    return static_cast<double>(end - first) / (resistance[end] - resistance[first]) * (weight[end] - weight[first]);
  }
};

}  // namespace

double bandNoiseShare(const Residuals& residuals, double period, const StrutModel& model) {
  std::vector<std::size_t> sizes;
  for (const std::vector<double>& segment : residuals) sizes.push_back(segment.size());
  const double natural_period = 2.0 * kPi / (std::sqrt(model.stiffness_to_mass) * period);
  const std::size_t length = Periodogram::lengthFor(sizes, natural_period);
  const double averages = Periodogram::kIndependent * static_cast<double>(Periodogram::windowsIn(sizes, length));
  if (averages < kFewestAverages) return 0.0;

  Periodogram periodogram(length);
  std::vector<double> power(length / 2, 0.0);
  Spectrum spectrum;
  for (const std::vector<double>& segment : residuals)
    for (std::size_t i = 0; i < Periodogram::windowsIn(segment.size(), length); ++i) {
      periodogram.of(&segment[i * (length / 2)], spectrum);
      for (std::size_t f = 1; f < length / 2; ++f) power[f] += std::norm(spectrum[f]);
    }
  BandSums sums;
  double all = 0.0;
  for (std::size_t f = 1; f < length / 2; ++f) {
    if (!(power[f] > 0.0)) return 0.0;
    const double frequency = static_cast<double>(f) / (static_cast<double>(length) * period);
    const double gain = transmissibility(model.damping_to_mass, model.stiffness_to_mass, frequency);
    sums.add(1.0 + gain * gain, power[f]);
    all += power[f];
  }
  // A sensor passes what is as slow as the strut; a band begins below that.
  const auto natural = static_cast<std::size_t>(static_cast<double>(length) / natural_period);
  double white = 0.0;
  for (std::size_t first = 0; first < std::min(natural, sums.weight.size() - 1); ++first)
    for (std::size_t end = first + 1; end < sums.weight.size(); ++end)
      white = std::max(white, sums.whiteIn(first, end));
  const double scatter = averages / (averages - 1.0);  // 1 / S of an average over so many windows is as much too large
  return std::min(1.0, scatter * white / all);
}

double floorOfResidual(double rmse, double noise_floor, const Residuals& residuals, double period,
                       const StrutModel& model) {
  const double in_band = rmse * std::sqrt(bandNoiseShare(residuals, period, model));
  return std::min(rmse, isStructured(rmse, in_band) ? noise_floor : std::max(noise_floor, in_band));
}

}  // namespace suspension_health_monitor
