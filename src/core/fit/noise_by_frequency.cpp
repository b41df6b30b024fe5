#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <vector>

#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/math/periodogram.h"

namespace suspension_health_monitor {
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
FitOutcome residualsOfNoise(const std::vector<CornerSample>& noise, double period, const StrutModel& model) {
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
  const FitOutcome noise = residualsOfNoise(records.front()->noise(), records.front()->period(), model);
  if (!fit || !noise) return 0.0;
  const std::vector<double> residual = powerOf(fit->residuals), known = powerOf(noise->residuals);
  const double mean = std::accumulate(known.begin(), known.end(), 0.0) / static_cast<double>(known.size());
  std::vector<double> levels;
  for (std::size_t f = 0; f < known.size(); ++f)
    if (known[f] > kNone * mean) levels.push_back(residual[f] / known[f]);
  return std::sqrt(median(levels)) * std::sqrt(meanSquare(noise->residuals));
}

}  // namespace suspension_health_monitor
