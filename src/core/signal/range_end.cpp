#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/signal/stream_gate.h"

namespace suspension_health_monitor {
namespace {

constexpr double kFarOut = 1.5;           // mean deviations from the mean: as far as a sine's peak
constexpr double kFineResolution = 0.02;  // step over span of a sensor whose repeated values mean something
constexpr double kBandOfSpan = 0.02;
constexpr double kBandSteps = 8.5;  // eight steps, however their differences are rounded

}  // namespace

void RangeEnd::add(double reading, int equal_in_a_row, const UsualReadings& usual) {
  count(reading, std::max(kBandOfSpan * usual.span, kBandSteps * usual.finest_step));
  countFlatTops(reading, equal_in_a_row, usual.repeated);
  if (!in_flat_top_ || flat_tops_ > 1 || equal_in_a_row < kStuck) {
    const bool far_out = std::abs(reading - usual.mean) > kFarOut * usual.deviation;
    const bool fine = usual.finest_step < kFineResolution * usual.span;
    // A sensor that reads 0 is dead: no range ends there.
    if (in_flat_top_ && usual.known && fine && reading != 0.0 && at_ > near_ && (far_out || flat_tops_ >= kAgain))
      limit_ = reading;
  } else {
    limit_.reset();
  }
}

void RangeEnd::count(double reading, double band) {
  const double beyond = extreme_ ? sign_ * (reading - *extreme_) : 0.0;
  if (!extreme_ || beyond > 0.0) {
    near_ = beyond <= band ? near_ + at_ : 0.0;  // those that the band has left behind as well: a little too many
    at_ = 1.0;
    flat_tops_ = 0;
    limit_.reset();
    extreme_ = reading;
  } else if (beyond == 0.0) {
    at_ += 1.0;
  } else if (beyond >= -band) {
    near_ += 1.0;
  }
}

void RangeEnd::countFlatTops(double reading, int equal_in_a_row, double repeated) {
  const double usual_run = 1.0 / std::max(1.0 - repeated, 1e-6);
  const bool flat = reading == extreme_ && equal_in_a_row + 0.5 > kFlatTop * usual_run;
  if (flat && !in_flat_top_) flat_tops_ = std::min(flat_tops_ + 1, kAgain);
  in_flat_top_ = flat;
}

}  // namespace suspension_health_monitor
