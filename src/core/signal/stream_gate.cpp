#include "suspension_health_monitor/internal/signal/stream_gate.h"

namespace suspension_health_monitor {
void RangeEnd::add(double reading, const ReadingStatistics& all, double span) {
  count(reading, std::max(kSignalTuning.fine * span, kSignalTuning.band_steps * all.finest_step));
  countFlatTops(reading, all);
  if (!in_flat_top_) return;
  if (flat_tops_ <= 1 && all.equal_in_a_row >= kSignalTuning.stuck) return limit_.reset();
  const bool far_out = std::abs(reading - all.average.mean()) > kSignalTuning.far_out * all.distance.mean();
  const bool fine = all.finest_step < kSignalTuning.fine * span;
  // A sensor that reads 0 is dead: no range ends there.
  if (all.areEnough() && fine && reading != 0.0 && at_ > near_ && (far_out || flat_tops_ >= kSignalTuning.flat_tops))
    limit_ = reading;
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

void RangeEnd::countFlatTops(double reading, const ReadingStatistics& all) {
  const double mean_run = 1.0 / std::max(1.0 - all.repeated.mean(), 1e-6);
  const bool flat = reading == extreme_ && all.equal_in_a_row + 0.5 > kSignalTuning.flat_top * mean_run;
  if (flat && !in_flat_top_) flat_tops_ = std::min(flat_tops_ + 1, kSignalTuning.flat_tops);
  in_flat_top_ = flat;
}

void ReadingStatistics::add(double reading, bool is_extreme) {
  const double step = last ? std::abs(reading - *last) : 0.0;
  equal_in_a_row = last && step == 0.0 ? std::min(equal_in_a_row + 1, kSignalTuning.stuck) : 1;
  if (step > 0.0) finest_step = finest_step > 0.0 ? std::min(finest_step, step) : step;
  last = reading;
  average.add(reading);
  distance.add(std::abs(reading - average.mean()));
  if (!is_extreme) repeated.add(step == 0.0 ? 1.0 : 0.0);
}

StreamGate::Verdict StreamGate::judge(Stamp stamp, double acceleration) {
  taken_.reset();
  if (!isUsable(acceleration)) return reject(RejectReason::kNotFinite);
  const std::optional<RejectReason> fault = faultOfStamp(stamp);
  if (fault) rejected_.add(*fault);
  const bool went_far_back = fault == RejectReason::kTimeWentBack && *last_ - stamp > longest_overtaking_;
  if (fault == RejectReason::kTimeWentBack && !went_far_back) clock_.passOver();
  if (fault && !went_far_back) return Verdict::kRejected;
  if (went_far_back) startNewSeries();
  const Verdict passes = went_far_back ? Verdict::kBeginsAnew : Verdict::kPasses;

  if (isAbsurd(acceleration)) {
    clock_.passOver();
    return reject(RejectReason::kAbsurd);
  }
  last_ = stamp;
  const Stamp taken = clock_.add(stamp, acceleration);
  if (!is_force_ && isClipped(acceleration)) return reject(RejectReason::kClipped);
  taken_ = taken;
  return passes;
}

void StreamGate::startNewSeries() {
  last_.reset();
  clock_.interrupt();
}

std::optional<RejectReason> StreamGate::faultOfStamp(Stamp stamp) const {
  if (!last_) return std::nullopt;
  if (stamp.count() == 0) return RejectReason::kZeroStamp;
  if (stamp == *last_) return RejectReason::kRepeatedStamp;
  if (stamp < *last_) return RejectReason::kTimeWentBack;
  return std::nullopt;
}

bool StreamGate::isAbsurd(double acceleration) {
  const double size = std::abs(acceleration);
  const double least = is_force_ ? kSignalTuning.most_in_any_unit : kSignalTuning.most_of_a_vehicle;
  const double most =
      std::clamp(kSignalTuning.absurd_over_median * median_size_.median(), least, kSignalTuning.most_in_any_unit);
  median_size_.add(size);
  believed_ = size > most ? 0 : std::min(believed_ + 1, kSignalTuning.believed_again);
  return believed_ < kSignalTuning.believed_again;
}

bool StreamGate::isClipped(double acceleration) {
  statistics_.add(acceleration, acceleration == upper_.extreme() || acceleration == lower_.extreme());
  const double span = upper_.extreme() ? *upper_.extreme() - *lower_.extreme() : 0.0;
  for (RangeEnd* end : {&upper_, &lower_}) end->add(acceleration, statistics_, span);
  return acceleration == upper_.limit() || acceleration == lower_.limit();
}

double StreamGate::farthest() const {
  if (!upper_.extreme()) return 0.0;
  return std::max(*upper_.extreme() - statistics_.average.mean(), statistics_.average.mean() - *lower_.extreme());
}

StreamGate::Verdict StreamGate::reject(RejectReason reason) {
  rejected_.add(reason);
  return Verdict::kRejected;
}

}  // namespace suspension_health_monitor
