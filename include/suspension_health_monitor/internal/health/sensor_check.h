#pragma once

#include <array>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Tells faults of a sensor from those of the strut, by what a strut cannot do:
/// - a vehicle does not climb for good: where gravity is on another axis than the settings say, that axis is wrong;
///   where one mean reading is gravity (REP 145: +9.81 at rest on the up axis) and the other is 1, that one is in g.
///   MountClaim judges the mean of each IMU alone;
/// - a strut passes slow motion as it is: the block estimate contains the ratio of the gains of both sensors;
/// - a strut takes energy: damping that is certainly negative is that of readings of which one has the wrong sign, and
///   a body that shakes three times as much as the wheel may be the wheel;
/// - a spring lets no wheel move without the body;
/// - a model that explains less than half of a signal that is motion, not noise (its steps from sample to sample are
///   smaller than white noise would have them), was given readings that do not belong together.
/// A verdict must last for the memory; a stuck sensor and a wrong axis are reported at once. kNegativeDamping and
/// kUnrelated are withdrawn as soon as the block estimate is valid. Samples of the grid come here, after the gate of
/// each stream (StreamGate). Cost per sample: O(1), no allocation.
class SensorCheck {
 public:
  /// @param memory  in samples, above 0.
  /// @param horizon_samples  of the filter, near a period of the body's bounce: what is ten times as fast is no motion
  /// of the strut but that of an engine.
  SensorCheck(double memory, int horizon_samples);

  void add(const CornerSample& sample);

  /// @param up  as SensorReport::up.
  void setUp(Side side, std::string_view up) { report_.up[indexOf(side)] = up; }

  /// @param estimate  of the blocks: a valid one is that of a strut.
  /// @param la  at the newest sample: its rows follow a fault at once, and single wrong readings do not move it.
  /// @param la_tells  LA has enough rows, and is not held, so that it may accuse a sensor.
  const SensorReport& judge(const StrutEstimate& estimate, const StrutEstimate& la, bool la_tells);

  const SensorReport& report() const { return report_; }

  /// @return share of the body's power of late above the strut's band, in [0, 1], and its rms [m/s^2].
  double bodyBeyondStrut() const;
  double bodyBeyondStrutLevel() const;

 private:
  struct Reading {
    Reading(double forgetting_factor, double band_gain) : limited(forgetting_factor), gain(band_gain) {}
    LimitedMean limited;
    double gain;            // of the low-pass that keeps the strut's band
    double smooth = 0.0;    // its output [m/s^2]
    double band = 0.0;      // variance of its output
    double last = 0.0;      // reading [m/s^2]
    double variance = 0.0;  // of the readings
    double step = 0.0;      // mean square of the difference from sample to sample
    double still = 0.0;     // samples without any change
    void add(double now, double quick);
    double mean() const { return limited.mean(); }
    bool isMotion() const { return step < variance; }  // that of white noise is twice that
    bool isOfStrut() const { return isMotion() && band > kBandShare * variance; }
  };

  static constexpr double kQuick = 10.0;      // variances have a tenth of the memory, so that a stop shows quickly
  static constexpr double kBandTimes = 10.0;  // corner of the low-pass over the bounce: the wheel's hop is below it
  static constexpr double kBandShare = 0.4;   // of the variance: the low-pass leaves half at the end of the band

  bool isStill(const Reading& reading) const { return 2.0 * reading.still >= memory_; }
  SensorFault find(const StrutEstimate& estimate, const StrutEstimate& la, bool la_tells) const;
  bool isInG() const;
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
