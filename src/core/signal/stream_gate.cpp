#include "suspension_health_monitor/internal/signal/stream_gate.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

// A hundred g: an impact that breaks wheels. Bumps into the stops are a few hundred m/s^2.
constexpr double kMostOfAVehicle = 1000.0;  // [m/s^2]
constexpr double kMostTimesUsual = 100.0;   // beyond that, whatever the unit
constexpr double kMostInAnyUnit = 1e9;      // [m/s^2]: a vehicle's in micro-g

}  // namespace

StreamGate::Verdict StreamGate::judge(Stamp stamp, double acceleration) {
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
  taken_ = clock_.add(stamp, acceleration);
  if (is_force_) return passes;
  if (isClipped(acceleration)) return reject(RejectReason::kClipped);
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
  const double least = is_force_ ? kMostInAnyUnit : kMostOfAVehicle;
  const double most = std::clamp(kMostTimesUsual * usual_size_.median(), least, kMostInAnyUnit);
  usual_size_.add(size);
  believed_ = size > most ? 0 : std::min(believed_ + 1, kBelievedAgain);
  return believed_ < kBelievedAgain;
}

bool StreamGate::isClipped(double acceleration) {
  statistics_.add(acceleration, acceleration == upper_.extreme() || acceleration == lower_.extreme());
  const UsualReadings usual = statistics_.usual(upper_.extreme() ? *upper_.extreme() - *lower_.extreme() : 0.0);
  upper_.add(acceleration, statistics_.equalInARow(), usual);
  lower_.add(acceleration, statistics_.equalInARow(), usual);
  return acceleration == upper_.limit() || acceleration == lower_.limit();
}

double StreamGate::farthest() const {
  if (!upper_.extreme()) return 0.0;
  return std::max(*upper_.extreme() - statistics_.mean(), statistics_.mean() - *lower_.extreme());
}

StreamGate::Verdict StreamGate::reject(RejectReason reason) {
  rejected_.add(reason);
  return Verdict::kRejected;
}

}  // namespace suspension_health_monitor
