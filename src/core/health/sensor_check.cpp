#include "suspension_health_monitor/internal/health/sensor_check.h"

#include <algorithm>

#include "suspension_health_monitor/internal/blocks/block_bins.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

SensorCheck::SensorCheck(double memory, int horizon_samples)
    : memory_(memory),
      unread_(1.0 - 1.0 / std::max(memory, 1.0), 1.0 / (1.0 + horizon_samples / (2.0 * M_PI * kBandTimes))) {}

double SensorCheck::bodyBeyondStrut() const {
  const Reading& body = readings_[0];
  return body.variance > 0.0 ? std::max(0.0, 1.0 - body.band / body.variance) : 0.0;
}

double SensorCheck::bodyBeyondStrutLevel() const { return std::sqrt(bodyBeyondStrut() * readings_[0].variance); }

void SensorCheck::Reading::add(double now, double quick) {
  still = now == last ? still + 1.0 : 0.0;
  const double off = now - mean(), change = now - last;
  last = now;
  limited.add(now);
  variance += quick * (off * off - variance);
  smooth += gain * (off - smooth);
  band += quick * (smooth * smooth - band);
  step += quick * (change * change - step);
}

void SensorCheck::add(const CornerSample& sample) {
  // What a sensor read while it was dead says nothing of its mean: that is learned anew.
  const auto revives = [&](const Reading& reading, double now) { return isStill(reading) && now != reading.last; };
  if (samples_ == 0.0 || revives(readings_[0], sample.sprung_acceleration) ||
      revives(readings_[1], sample.unsprung_acceleration)) {
    readings_ = {unread_, unread_};
    readings_[0].last = sample.sprung_acceleration;
    readings_[1].last = sample.unsprung_acceleration;
    samples_ = pending_since_ = 0.0;
  }
  samples_ += 1.0;
  const double quick = std::min(1.0, kQuick / std::min(samples_, memory_));
  readings_[0].add(sample.sprung_acceleration, quick);
  readings_[1].add(sample.unsprung_acceleration, quick);
}

const SensorReport& SensorCheck::judge(const StrutEstimate& estimate, const StrutEstimate& la, bool la_tells) {
  const SensorFault found = find(estimate, la, la_tells);
  if (found != pending_) pending_since_ = samples_;
  pending_ = found;
  const bool stuck = found == SensorFault::kSprungStuck || found == SensorFault::kUnsprungStuck;
  const bool of_motion = report_.fault == SensorFault::kNegativeDamping || report_.fault == SensorFault::kUnrelated;
  if (of_motion && estimate.tellsChanges()) report_.fault = SensorFault::kNone;
  if (stuck || found == SensorFault::kOtherAxis || samples_ - pending_since_ >= memory_) {
    report_.fault = found;
    report_.mean = {readings_[0].mean(), readings_[1].mean()};
    if (found == SensorFault::kGainsDiffer) report_.gain = estimate.gain;
  }
  return report_;
}

SensorFault SensorCheck::find(const StrutEstimate& estimate, const StrutEstimate& la, bool la_tells) const {
  const bool sprung_still = isStill(readings_[0]), unsprung_still = isStill(readings_[1]);
  if (sprung_still && unsprung_still) return SensorFault::kNone;  // at rest, and nothing resolves its noise
  if (sprung_still) return SensorFault::kSprungStuck;
  if (unsprung_still) return SensorFault::kUnsprungStuck;
  const bool is_on_other_axis = !report_.up[0].empty() || !report_.up[1].empty();
  if (is_on_other_axis && !estimate.tellsChanges()) return SensorFault::kOtherAxis;
  if (samples_ < memory_) return SensorFault::kNone;
  if (isInG()) return SensorFault::kInG;
  if (estimate.tellsChanges()) {
    const bool differ = estimate.explained > kBlockTuning.nearly_all &&
                        std::abs(estimate.gain) > kLeastDifference + kProven * estimate.gain_stddev;
    return differ ? SensorFault::kGainsDiffer : SensorFault::kNone;
  }
  if (estimate.doubt == EstimateDoubt::kVehicleFile) return SensorFault::kNone;  // that is the reason, for all struts
  return la_tells ? judgeMotion(la) : SensorFault::kNone;
}

SensorFault SensorCheck::judgeMotion(const StrutEstimate& la) const {
  // Of what an engine does to the body the wheel explains nothing.
  const double least_explained = kMajority * (1.0 - std::sqrt(bodyBeyondStrut()));
  const bool is_strut = la.explained >= least_explained && la.damping_to_mass > 0.0 && la.stiffness_to_mass > 0.0;
  if (is_strut) return SensorFault::kNone;
  const bool body_moves = readings_[0].isOfStrut(), wheel_moves = readings_[1].isMotion();
  if (body_moves && la.damping_to_mass < -kCertain * la.damping_to_mass_stddev) return SensorFault::kNegativeDamping;
  const bool may_be_swapped = readings_[0].band > square(kMuchMore) * readings_[1].band;
  return wheel_moves && (body_moves || may_be_swapped) ? SensorFault::kUnrelated : SensorFault::kNone;
}

bool SensorCheck::isInG() const {
  const auto [smaller, larger] = std::minmax({std::abs(readings_[0].mean()), std::abs(readings_[1].mean())});
  return std::abs(larger - kStandardGravity) < kGravityTolerance * kStandardGravity && readsInG(smaller);
}

}  // namespace suspension_health_monitor
