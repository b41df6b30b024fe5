#include "suspension_health_monitor/health/sensor_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suspension_health_monitor {
namespace {

constexpr double kGravity = 9.80665;      // [m/s^2]
constexpr double kExplained = 0.5;        // less is not this strut

bool hasGravity(double mean) { return std::abs(mean) > kGravity / 2.0; }

std::string withMean(const char* sensor, double mean) {
  char text[160];
  std::snprintf(text, sizeof text, "the %s IMU reads %.2f m/s^2 on average, neither %.2f nor 0: gain, offset or mount",
                sensor, mean, kGravity);
  return text;
}

}  // namespace

void SensorCheck::Reading::add(double before, double now, double slow, double quick) {
  still = now == last ? std::min(still + 1, kStill) : 0;
  last = now;
  const double off = now - mean;
  mean += slow * off;
  variance += quick * (off * off - variance);
  step += quick * ((now - before) * (now - before) - step);
}

const SensorReport& SensorCheck::look(const CornerSample& previous, const CornerSample& sample,
                                      const StrutEstimate& la, bool enough_rows) {
  // What a sensor read while it was dead says nothing of its mean: that is learned anew.
  const auto revives = [](const Reading& reading, double now) { return reading.still == kStill && now != reading.last; };
  if (revives(readings_[0], sample.sprung_acceleration) || revives(readings_[1], sample.unsprung_acceleration)) {
    readings_ = {};
    looked_ = 0.0;
  }
  looked_ += 1.0;
  const double slow = 1.0 / std::min(looked_, memory_), quick = std::min(1.0, kQuick / std::min(looked_, memory_));
  readings_[0].add(previous.sprung_acceleration, sample.sprung_acceleration, slow, quick);
  readings_[1].add(previous.unsprung_acceleration, sample.unsprung_acceleration, slow, quick);
  const SensorFault found = judge(la, enough_rows);
  lasted_ = found == pending_ ? lasted_ + 1.0 : 0.0;
  pending_ = found;
  if (lasted_ >= memory_ || (found != SensorFault::kNone && readings_[0].still + readings_[1].still >= kStill)) {
    report_.fault = found;
    report_.mean = {readings_[0].mean, readings_[1].mean};
  }
  return report_;
}

SensorFault SensorCheck::judge(const StrutEstimate& la, bool enough_rows) {
  const bool sprung_still = readings_[0].still == kStill, unsprung_still = readings_[1].still == kStill;
  if (sprung_still && unsprung_still) return SensorFault::kNone;  // at rest, and nothing resolves its noise
  if (sprung_still) return SensorFault::kSprungStuck;
  if (unsprung_still) return SensorFault::kUnsprungStuck;
  if (looked_ < memory_) return SensorFault::kNone;
  if (const SensorFault fault = judgeMeans(); fault != SensorFault::kNone) return fault;
  const bool moves = readings_[0].isMotion() && readings_[1].isMotion();
  const bool is_strut = la.explained >= kExplained && la.damping_to_mass > 0.0 && la.stiffness_to_mass > 0.0;
  return enough_rows && moves && !is_strut ? SensorFault::kUnrelated : SensorFault::kNone;
}

SensorFault SensorCheck::judgeMeans() const {
  if (tolerance_ == 0.0) return SensorFault::kNone;
  if (isOff(readings_[0])) return SensorFault::kSprungGravity;
  if (isOff(readings_[1])) return SensorFault::kUnsprungGravity;
  const auto clear = [](const Reading& reading) { return kMeanNoise * std::sqrt(reading.variance) < kGravity / 4.0; };
  if (clear(readings_[0]) && clear(readings_[1]) && hasGravity(readings_[0].mean) != hasGravity(readings_[1].mean))
    return SensorFault::kGravityOnOneSide;
  return SensorFault::kNone;
}

bool SensorCheck::isOff(const Reading& reading) const {
  const double off = std::min(std::abs(reading.mean), std::abs(std::abs(reading.mean) - kGravity));
  return off > tolerance_ * kGravity + kMeanNoise * std::sqrt(reading.variance);
}

std::string describe(const SensorReport& report) {
  char text[160];
  switch (report.fault) {
    case SensorFault::kNone:
      return {};
    case SensorFault::kSprungStuck:
      return "the sprung IMU reads one value while the unsprung one moves: stuck";
    case SensorFault::kUnsprungStuck:
      return "the unsprung IMU reads one value while the sprung one moves: stuck";
    case SensorFault::kSprungGravity:
      return withMean("sprung", report.mean[0]);
    case SensorFault::kUnsprungGravity:
      return withMean("unsprung", report.mean[1]);
    case SensorFault::kGravityOnOneSide:
      std::snprintf(text, sizeof text,
                    "mean readings %.2f (sprung) and %.2f m/s^2 (unsprung): only one of the IMUs reads gravity",
                    report.mean[0], report.mean[1]);
      return text;
    case SensorFault::kUnrelated:
      return "both IMUs move, but no strut makes the one of the other: sensor fault, wrong axis or wrong topic";
    case SensorFault::kWrongPeriod:
      return "stamps do not fit sample_period";
  }
  return {};
}

}  // namespace suspension_health_monitor
