#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/math/periodogram.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kWindow = 128;  // samples
constexpr std::size_t kAtLimit = 4;   // frequencies below half the rate, a sixteenth of all
constexpr double kNone = 0.01;        // of the mean: where a filter leaves less of the noise it tells nothing

/// Power by frequency, 0 to half the rate, summed over windows: one column for each of `parts` parts of the residuals.
/// That of a constant is left out.
Eigen::ArrayXXd sumsOfPower(const Residuals& residuals, std::size_t length, std::size_t parts) {
  const std::vector<std::size_t> sizes = sizesOf(residuals);
  const std::size_t windows = Periodogram::windowsIn(sizes, length);
  Periodogram periodogram(length);
  Spectrum spectrum;
  Eigen::ArrayXXd sums = Eigen::ArrayXXd::Zero(length / 2 + 1, parts);
  std::size_t window = 0;
  Periodogram::forEachWindow(sizes, length, [&](std::size_t segment, std::size_t first) {
    periodogram.of(&residuals[segment][first], spectrum);
    auto sum = sums.col(window++ * parts / windows);
    for (std::size_t f = 1; f <= length / 2; ++f) sum[f] += std::norm(spectrum[f]);
  });
  return sums;
}

Eigen::ArrayXd meanPower(const Residuals& residuals) {
  const auto windows = static_cast<double>(Periodogram::windowsIn(sizesOf(residuals), kWindow));
  return sumsOfPower(residuals, kWindow, 1) / std::max(1.0, windows);
}

/// What the noise of all sensors leaves of a linear model's free run.
FitOutcome residualsOfNoise(const std::vector<CornerSample>& noise, double period, const StrutModel& model) {
  const StrutModel linear{model.damping_to_mass, model.stiffness_to_mass, {}, {}};
  const std::deque<DriveRecord> records = makeRecords({Drive{noise}}, period, linear);
  return withoutFit(pointersTo(records), linear);
}

/// rms of white noise that is as dense as w'' just below half the rate.
double levelAtLimit(const Records& records) {
  const Eigen::ArrayXd power = meanPower(mapped(segmentsOf(records), &DriveSegment::unsprung));
  const double at_limit = power.tail(1 + kAtLimit).head(kAtLimit).sum() / kAtLimit;
  return std::sqrt(at_limit / Periodogram(kWindow).taperPower());
}

constexpr std::size_t kParts = 4;  // of the drives, in each of which noise is the same
// Power of the noise of the wheel's sensor to the body's: alike first, up to ranges of 400 and 12 g.
constexpr std::array kRatios{1.0, 0.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0};
constexpr std::size_t kWindowsOfPart = 12;  // at least, for an average over them

/// @param readings  sums of their power in each part.  @param averages  independent ones in each.
/// @return the most power that white noise of a sensor can have at one frequency: the lowest that its readings show at
/// any, 3 standard deviations of an average above it.
double mostNoise(const Eigen::ArrayXXd& readings, double averages) {
  double lowest = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 1; f + 1 < readings.rows(); ++f) lowest = std::min(lowest, readings.row(f).sum() / kParts);
  return lowest / (1.0 - kProven / std::sqrt(kParts * averages));
}

/// @param gain  |G|^2 by frequency.  @param resistance  the sum of 1 / S over the parts.
/// @param natural  natural frequency.  @param most  of the wheel's noise, as mostNoise().
/// @return the most of the residual's power that noise explains in a band if the wheel's is r times the body's.
double mostExplained(double r, const std::vector<double>& gain, const std::vector<double>& resistance,
                     std::size_t natural, double most) {
  double largest = 0.0;
  for (std::size_t first = 1; first <= natural; ++first) {
    double weight = 0.0, resisted = 0.0;  // sums of g, and of g^2 / S, over frequencies and parts
    for (std::size_t f = first; f < gain.size(); ++f) {
      const double g = 1.0 + r * gain[f];
      weight += kParts * g;
      resisted += g * g * resistance[f];
      const double level = r > 1.0 ? std::min(weight / resisted, most / r) : weight / resisted;
      if (f > 2 * natural) largest = std::max(largest, level * weight);
    }
  }
  return largest;
}

/// Noise of a sensor that is louder than the other's, or that a sensor has filtered, as most do inside: white within a
/// band, next to nothing beyond it. An interpolation (noise_floor.cpp) sees neither. What a free run leaves is such
/// noise if it is white within a band of its own, and the same in every quarter of the drives; what a law leaves is
/// strong near resonance and weak elsewhere, or goes with a sweep.
///
/// White noise of both sensors has the spectrum n g(f), g = 1 + r |G(f)|^2 for what comes through the model. The
/// largest that fits under the spectrum S of the residual in a band has n = sum(g) / sum(g^2 / S), the harmonic mean of
/// S / g over frequencies and quarters, weighted by the power g: n sum(g) reaches sum(S) only if S has the shape of g
/// (Cauchy and Schwarz). The band and r are where n sum(g) is largest; the wheel's noise, n r, is not above mostNoise()
/// of its readings.
/// @param residuals  of a fit of the model.  @param wheel  w'', at the same samples.
/// @return its rms as a share of the residual's; 0 if there are too few samples to tell.
NoiseFloor bandNoise(const Residuals& residuals, const Residuals& wheel, double period, const StrutModel& model) {
  const double natural_period = 2.0 * M_PI / (std::sqrt(model.stiffness_to_mass) * period);
  const std::vector<std::size_t> sizes = sizesOf(residuals);
  const std::size_t length = Periodogram::lengthFor(sizes, natural_period, kParts * kWindowsOfPart);
  const std::size_t windows = Periodogram::windowsIn(sizes, length), count = length / 2;
  if (windows < kParts * kWindowsOfPart) return {};
  const double averages = Periodogram::kIndependent * static_cast<double>(windows / kParts);  // of each part
  const Eigen::ArrayXXd spectra = sumsOfPower(residuals, length, kParts);
  std::vector<double> gain(count), resistance(count);  // |G|^2, and the sum of 1 / S over the parts
  double all = 0.0;
  for (std::size_t f = 1; f < count; ++f) {
    const double frequency = static_cast<double>(f) / (static_cast<double>(length) * period);
    gain[f] = square(transmissibility(model.damping_to_mass, model.stiffness_to_mass, frequency));
    if (!(spectra.row(f) > 0.0).all()) return {};
    resistance[f] = spectra.row(f).inverse().sum();
    all += spectra.row(f).sum();
  }
  // A sensor passes what the strut does: the band begins below its natural frequency and goes beyond twice that.
  const auto natural = static_cast<std::size_t>(static_cast<double>(length) / natural_period);
  const double most = mostNoise(sumsOfPower(wheel, length, kParts), averages);
  // Chance lets one r fit a little better than the true one: what is larger by chance only is not taken.
  const double beyond_chance = 1.0 + kProven / std::sqrt(kParts * averages * static_cast<double>(count));
  double white = 0.0, louder = 1.0;
  for (const double r : kRatios) {
    const double largest = mostExplained(r, gain, resistance, natural, most);
    if (largest <= beyond_chance * white) continue;
    white = largest;
    louder = r;
  }
  // By this factor the mean of 1 / S is too large where S is an average over so many windows.
  const double scatter = averages / (averages - 1.0);
  // Of the residuals' power the spectra lack what is slower than the windows are long: an offset, and what wanders.
  // White noise of variance 1 has the sum `unit`.
  const double unit = static_cast<double>(windows) * static_cast<double>(count - 1) * Periodogram(length).taperPower();
  const double shown = all / unit, whole = meanSquare(residuals);
  const double slow = whole > shown ? 1.0 - shown / whole : 0.0;
  return {std::sqrt(std::min(1.0, scatter * white / all) * (1.0 - slow)), louder};
}

}  // namespace

double shareAtSamplingLimit(const Records& records) {
  const double power = meanSquare(mapped(segmentsOf(records), &DriveSegment::unsprung));
  return power > 0.0 ? levelAtLimit(records) / std::sqrt(power) : 0.0;
}

double foldedMotion(const Records& records, const StrutModel& model) {
  const double half_the_rate = 0.5 / records.front()->period();
  return levelAtLimit(records) * transmissibility(model.damping_to_mass, model.stiffness_to_mass, half_the_rate);
}

double floorOfKnownNoise(const Records& records, const StrutModel& model) {
  const FitOutcome fit = withoutFit(records, model);
  const FitOutcome noise = residualsOfNoise(records.front()->noise(), records.front()->period(), model);
  if (!fit || !noise) return 0.0;
  const Eigen::ArrayXd residual = meanPower(fit->residuals), known = meanPower(noise->residuals);
  const double mean = known.sum() / static_cast<double>(kWindow / 2);
  std::vector<double> levels;
  for (Eigen::Index f = 0; f < known.size(); ++f)
    if (known[f] > kNone * mean) levels.push_back(residual[f] / known[f]);
  return std::sqrt(median(levels)) * std::sqrt(meanSquare(noise->residuals));
}

NoiseFloor floorOfResidual(double rmse, double noise_floor, const Residuals& residuals, const Residuals& wheel,
                           double period, const StrutModel& model) {
  const NoiseFloor in_band = bandNoise(residuals, wheel, period, model);
  if (isStructured(rmse, rmse * in_band.rms)) return {std::min(rmse, noise_floor)};
  return {std::min(rmse, std::max(noise_floor, rmse * in_band.rms)), in_band.wheel_to_body};
}

}  // namespace suspension_health_monitor
