#pragma once

#include <array>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/running_means.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

inline constexpr double kMuchLarger = 3.0;  ///< rms of the body over that of the wheel: they may be swapped

/// Tells faults of a sensor from those of the strut, by what a strut cannot do:
/// - a vehicle does not climb for good: where one mean reading is gravity (REP 145: +9.81 at rest on the up axis) and
///   the other is 1, that one is in g. What else a mean tells of one IMU MountClaim judges;
/// - a strut passes slow motion as it is: of both sensors' gains the blocks know the difference;
/// - a strut takes energy: damping that is certainly negative is that of readings of which one has the wrong sign, and
///   a body that shakes three times as much as the wheel may be the wheel;
/// - a spring lets no wheel move without the body;
/// - a model that explains less than half of a signal that is motion, not noise (its steps from sample to sample are
///   smaller than white noise would have them), was given readings that do not belong together.
/// Each verdict must have lasted for the memory; one on how they move falls with the first valid estimate.
/// Cost per sample: O(1), no allocation.
class SensorCheck {
 public:
  /// @param memory  in samples, above 0.
  /// @param horizon_samples  of the filter, near a period of the body's bounce: what is ten times as fast is no motion
  /// of the strut but that of an engine.
  SensorCheck(double memory, int horizon_samples);

  void add(const CornerSample& sample);

  /// @param estimate  of the blocks: a valid one is that of a strut.
  /// @param la  at the newest sample.
  /// @param la_tells  it rests on enough rows of the present motion to tell what the sensors do.
  const SensorReport& judge(const StrutEstimate& estimate, const StrutEstimate& la, bool la_tells);

  const SensorReport& report() const { return report_; }

  /// @return share of the body's power of late above the strut's band, in [0, 1], and its rms [m/s^2].
  double bodyBeyondStrut() const;
  double bodyBeyondStrutLevel() const;

 private:
  struct Reading {
    Reading(double forgetting_factor, double band_gain) : limited(forgetting_factor), gain(band_gain) {}
    LimitedMean limited;
    double gain, smooth = 0.0,
                 band = 0.0;  // of the low-pass that leaves the strut's band; its output, and the variance
    double last = 0.0, variance = 0.0, step = 0.0;  // step: mean square from sample to sample
    double still = 0.0;                             // samples without any change
    void add(double now, double quick);
    double mean() const { return limited.mean(); }
    bool isMotion() const { return step < kWhiteShare * 2.0 * variance; }
    bool isOfStrut() const { return isMotion() && band > kBandShare * variance; }
  };

  static constexpr double kQuick = 10.0;  // motion is forgotten so much sooner than the mean: else a stop takes long
  static constexpr double kWhiteShare = 0.5;  // of 2 variance, the mean square step of white noise
  static constexpr double kBandTimes = 10.0;  // the bounce: a wheel hops below that
  static constexpr double kBandShare = 0.4;   // of the variance: the low-pass leaves half at the end of the band
  static constexpr double kStill = 0.5;       // of the memory

  bool isStill(const Reading& reading) const { return reading.still >= kStill * memory_; }
  SensorFault find(const StrutEstimate& estimate, const StrutEstimate& la, bool la_tells) const;
  bool isInG() const;
  static SensorFault judgeGains(const StrutEstimate& estimate);
  SensorFault judgeMotion(const StrutEstimate& la) const;

  double memory_;
  Reading unread_;
  double samples_ = 0.0;        // taken in since a sensor came back
  double pending_since_ = 0.0;  // in samples taken in
  SensorFault pending_ = SensorFault::kNone;
  std::array<Reading, 2> readings_{unread_, unread_};
  SensorReport report_;
};

}  // namespace suspension_health_monitor
