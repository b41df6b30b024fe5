#include <algorithm>
#include <cmath>
#include <complex>
#include <deque>
#include <numeric>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/periodogram.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kParts = 4;           // of the drives, in each of which noise is the same
constexpr std::size_t kWindowsOfPart = 12;  // at least, for an average over them

/// Spectra of the residuals, part by part.
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

/// The share of the residuals' power that is slower than the windows are long, which no spectrum of theirs has: an
/// offset, and what wanders.
/// @param in_spectra  the power that these have.
double shareOfSlow(const Residuals& residuals, double in_spectra, const PartSpectra& spectra) {
  const double shown = in_spectra / spectra.unit, whole = meanSquare(residuals);
  return whole > shown ? 1.0 - shown / whole : 0.0;
}

}  // namespace

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
  const double scatter =
      spectra->averages / (spectra->averages - 1.0);  // 1 / S of an average over so many windows is as much too large
  return std::min(1.0, scatter * white / all) * (1.0 - shareOfSlow(residuals, all, *spectra));
}

double floorOfResidual(double rmse, double noise_floor, const Residuals& residuals, double period,
                       const StrutModel& model) {
  const double in_band = rmse * std::sqrt(bandNoiseShare(residuals, period, model));
  return std::min(rmse, isStructured(rmse, in_band) ? noise_floor : std::max(noise_floor, in_band));
}

namespace {

constexpr std::size_t kWindow = 128;  // samples
constexpr std::size_t kAtLimit = 4;   // frequencies below half the rate, a sixteenth of all
constexpr double kNone = 0.01;        // of the mean: where a filter leaves less of the noise it tells nothing

/// Mean power by frequency, without that of a constant.
std::vector<double> powerOf(const Residuals& residuals) {
  Periodogram periodogram(kWindow);
  Spectrum spectrum;
  std::vector<double> power(kWindow / 2, 0.0);
  double windows = 0.0;
  Periodogram::forEachWindow(sizesOf(residuals), kWindow, [&](std::size_t segment, std::size_t first) {
    periodogram.of(&residuals[segment][first], spectrum);
    for (std::size_t f = 1; f <= power.size(); ++f) power[f - 1] += std::norm(spectrum[f]);
    windows += 1.0;
  });
  for (double& each : power) each /= std::max(1.0, windows);
  return power;
}

/// What the noise of all sensors leaves of a linear model's free run.
FitOutcome leftOfNoise(const std::vector<CornerSample>& noise, double period, const StrutModel& model) {
  const StrutModel linear{model.damping_to_mass, model.stiffness_to_mass, {}, {}};
  const std::deque<DriveRecord> records = makeRecords({Drive{noise}}, period, linear);
  return withoutFit(pointersTo(records), linear);
}

/// rms of white noise that is as dense as w'' just below half the rate.
double levelAtLimit(const Records& records) {
  const std::vector<double> power = powerOf(seriesOf(segmentsOf(records), &DriveSegment::unsprung));
  const double at_limit = std::accumulate(power.end() - 1 - kAtLimit, power.end() - 1, 0.0) / kAtLimit;
  return std::sqrt(at_limit / Periodogram(kWindow).taperPower());
}

}  // namespace

double shareAtSamplingLimit(const Records& records) {
  const double power = meanSquare(seriesOf(segmentsOf(records), &DriveSegment::unsprung));
  return power > 0.0 ? levelAtLimit(records) / std::sqrt(power) : 0.0;
}

double foldedMotion(const Records& records, const StrutModel& model) {
  const double half_the_rate = 0.5 / records.front()->period();
  return levelAtLimit(records) * transmissibility(model.damping_to_mass, model.stiffness_to_mass, half_the_rate);
}

double floorOfKnownNoise(const Records& records, const StrutModel& model) {
  const FitOutcome fit = withoutFit(records, model);
  const FitOutcome noise = leftOfNoise(records.front()->noise(), records.front()->period(), model);
  if (!fit || !noise) return 0.0;
  const std::vector<double> left = powerOf(fit->residuals), known = powerOf(noise->residuals);
  const double mean = std::accumulate(known.begin(), known.end(), 0.0) / static_cast<double>(known.size());
  std::vector<double> levels;
  for (std::size_t f = 0; f < known.size(); ++f)
    if (known[f] > kNone * mean) levels.push_back(left[f] / known[f]);
  return std::sqrt(median(levels)) * std::sqrt(meanSquare(noise->residuals));
}

}  // namespace suspension_health_monitor
