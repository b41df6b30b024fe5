#include <cmath>
#include <complex>

#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/periodogram.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kWindow = 128;
constexpr std::size_t kAtLimit = 4;  // frequencies below half the rate, a sixteenth of all

/// rms of white noise that is as dense as w'' just below half the rate.
double levelAtLimit(const Records& records) {
  Periodogram periodogram(kWindow);
  Spectrum spectrum;
  double power = 0.0, count = 0.0;
  for (const DriveSegment* segment : segmentsOf(records))
    for (std::size_t i = 0; i < Periodogram::windowsIn(segment->size(), kWindow); ++i) {
      periodogram.of(&segment->unsprung[i * (kWindow / 2)], spectrum);
      for (std::size_t f = kWindow / 2 - kAtLimit; f < kWindow / 2; ++f) power += std::norm(spectrum[f]);
      count += static_cast<double>(kAtLimit);
    }
  return count > 0.0 ? std::sqrt(power / (count * periodogram.taperPower())) : 0.0;
}

}  // namespace

double shareAtSamplingLimit(const Records& records) {
  double squares = 0.0, count = 0.0;
  for (const DriveSegment* segment : segmentsOf(records))
    for (const double w : segment->unsprung) {
      squares += square(w);
      count += 1.0;
    }
  return squares > 0.0 ? levelAtLimit(records) / std::sqrt(squares / count) : 0.0;
}

double foldedMotion(const Records& records, const StrutModel& model) {
  const double half_the_rate = 0.5 / records.front()->period();
  return levelAtLimit(records) * transmissibility(model.damping_to_mass, model.stiffness_to_mass, half_the_rate);
}

}  // namespace suspension_health_monitor
