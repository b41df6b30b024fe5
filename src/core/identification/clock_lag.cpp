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

constexpr double kLargestLag = 0.05, kLagStep = 0.005;  // [s]
constexpr std::size_t kSamplesOfSurvey = 10000;         // of all drives; a lag shows in every one
constexpr int kLongestHorizon = 512;                    // samples
constexpr double kLongestStep = 1e6;                    // samples; no drive is sampled so densely

/// Which of the readings is taken for the body's.
enum class Roles { kAsGiven, kSwapped };

/// Samples from the middle of the drive on, the body's readings taken from `lag` samples later.
void survey(const Drive& drive, std::ptrdiff_t lag, Roles roles, std::size_t most, double period,
            HorizonSurvey& survey) {
  const auto count = static_cast<std::ptrdiff_t>(drive.samples.size());
  const auto wanted = std::min(count, static_cast<std::ptrdiff_t>(most));
  const std::ptrdiff_t begin = (count - wanted) / 2;
  std::optional<Stamp> last;
  for (std::ptrdiff_t k = std::max(begin, -lag); k < std::min(begin + wanted, count - lag); ++k) {
    const CornerSample& here = drive.samples[static_cast<std::size_t>(k)];
    const CornerSample& later = drive.samples[static_cast<std::size_t>(k + lag)];
    const double moved = toSeconds(later.stamp - here.stamp) / period - static_cast<double>(lag);
    CornerSample pair{here.stamp, later.sprung_acceleration, here.unsprung_acceleration};
    if (roles == Roles::kSwapped) pair = {here.stamp, later.unsprung_acceleration, here.sprung_acceleration};
    const bool usable =
        std::abs(moved) < 0.5 && isUsable(pair.sprung_acceleration) && isUsable(pair.unsprung_acceleration);
    if (!usable || !last || continuity(here.stamp - *last, fromSeconds(period)) != Continuity::kContinues)
      survey.interrupt();
    last = here.stamp;
    if (usable) survey.push(pair);
  }
}

struct Found {
  HorizonSurvey::Result strut{};  // explained is 0 if there is none
  int lag = 0;                    // [samples]
};

Found bestOver(const std::vector<Drive>& drives, Roles roles, double period) {
  const int step = static_cast<int>(std::clamp(std::round(kLagStep / period), 1.0, kLongestStep));
  const int most = static_cast<int>(std::min(kLargestLag / period + 0.5, kLargestLag / kLagStep * kLongestStep)) / step;
  Found best;
  for (int i = -most; i <= most; ++i) {
    HorizonSurvey horizons(period, IntegralFilterOptions{}.rule, kLongestHorizon);
    for (const Drive& drive : drives)
      survey(drive, i * step, roles, kSamplesOfSurvey / drives.size(), period, horizons);
    const std::optional<HorizonSurvey::Result> result = horizons.result();
    if (result && result->explained > best.strut.explained) best = {*result, i * step};
  }
  return best;
}

}  // namespace

std::optional<LaggedStrut> lookForClockLag(const std::vector<Drive>& drives, double period) {
  const Found best = bestOver(drives, Roles::kAsGiven, period);
  if (best.lag == 0 || best.strut.explained < HorizonSurvey::kClear) return std::nullopt;
  // A lag of one may be the lead of the other: sensors that are swapped.
  if (bestOver(drives, Roles::kSwapped, period).strut.explained >= best.strut.explained) return std::nullopt;
  LaggedStrut strut{{best.strut.damping_to_mass, best.strut.stiffness_to_mass, {}, {}}, best.strut.horizon_samples};
  strut.model.reading.push_back({findEffect(measurementEffects(), "clock_offset"), {best.lag * period}});
  return strut;
}

}  // namespace suspension_health_monitor
