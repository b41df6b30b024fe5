#include "suspension_health_monitor/internal/identification/clock_lag.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/identification/horizon_survey.h"
#include "suspension_health_monitor/internal/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLargestLag = 0.05, kStep = 0.005;  // [s]
constexpr std::size_t kMostSamples = 10000;          // of all drives; a lag shows in every one
constexpr int kLongestHorizon = 512;                 // samples

/// Samples from the middle of the drive on, the body's readings taken from `lag` samples later.
void survey(const Drive& drive, std::ptrdiff_t lag, std::size_t most, double period, HorizonSurvey& survey) {
  const auto count = static_cast<std::ptrdiff_t>(drive.samples.size());
  const auto wanted = std::min(count, static_cast<std::ptrdiff_t>(most));
  const std::ptrdiff_t begin = (count - wanted) / 2;
  std::optional<Stamp> last;
  for (std::ptrdiff_t k = std::max(begin, -lag); k < std::min(begin + wanted, count - lag); ++k) {
    const CornerSample& wheel = drive.samples[static_cast<std::size_t>(k)];
    const CornerSample& body = drive.samples[static_cast<std::size_t>(k + lag)];
    const double moved = toSeconds(body.stamp - wheel.stamp) / period - static_cast<double>(lag);
    const bool usable =
        std::abs(moved) < 0.5 && isUsable(wheel.unsprung_acceleration) && isUsable(body.sprung_acceleration);
    if (!usable || !last || continuity(wheel.stamp - *last, fromSeconds(period)) != Continuity::kContinues)
      survey.interrupt();
    last = wheel.stamp;
    if (usable) survey.push({wheel.stamp, body.sprung_acceleration, wheel.unsprung_acceleration});
  }
}

}  // namespace

std::optional<LaggedStrut> lookForClockLag(const std::vector<Drive>& drives, double period) {
  const int step = std::max(1, static_cast<int>(std::lround(kStep / period)));
  const int most = static_cast<int>(kLargestLag / period + 0.5) / step;
  std::optional<HorizonSurvey::Result> best;
  int best_lag = 0;
  for (int i = -most; i <= most; ++i) {
    HorizonSurvey horizons(period, IntegralFilterOptions{}.rule, kLongestHorizon);
    for (const Drive& drive : drives) survey(drive, i * step, kMostSamples / drives.size(), period, horizons);
    const std::optional<HorizonSurvey::Result> result = horizons.result();
    if (!result || (best && result->explained <= best->explained)) continue;
    best = result;
    best_lag = i * step;
  }
  if (!best || best_lag == 0 || best->explained < HorizonSurvey::kClear) return std::nullopt;
  LaggedStrut strut{{best->damping_to_mass, best->stiffness_to_mass, {}, {}}, best->horizon_samples};
  strut.model.reading.push_back({findEffect(measurementEffects(), "clock_offset"), {best_lag * period}});
  return strut;
}

}  // namespace suspension_health_monitor
