#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/model/strut_integrator.h"

namespace suspension_health_monitor {

/// An uninterrupted, uniformly sampled stretch of a drive, prepared for free runs.
struct DriveSegment {
  double start = 0.0;            ///< time of its first sample since the start of the drive [s]
  std::vector<double> sprung;    ///< z'' less the drive's mean w'' [m/s^2], one per sample
  std::vector<double> unsprung;  ///< w'' less its mean [m/s^2], one per sample
  std::vector<WheelStep> wheel;  ///< what the wheel does, one per integration step

  std::size_t size() const { return sprung.size(); }
};

/// A drive as a whole, kept for comparison and for fits.
///
/// The mean of w'' is taken off both signals: a vehicle stays where it is, so this is gravity and the offset of the
/// wheel's sensor; what the body's sensor has besides stays.
/// A stretch ends at a gap, and where a sensor repeats one value: a reading that is stuck or lost.
/// Samples at the ends of a stretch that the interpolation of w'' needs are not part of it.
class DriveRecord {
 public:
  /// @param period  sampling time T [s].
  /// @param steps  integration steps per sample, >= 1.
  DriveRecord(double period, int steps);

  /// Takes in the next sample; gaps are noticed by its stamp.
  void push(const CornerSample& sample);

  /// To be called once after the last sample: interpolates.
  void finish();

  double period() const { return period_; }
  int steps() const { return steps_; }
  const std::vector<DriveSegment>& segments() const { return segments_; }
  std::size_t numSamples() const;
  double gravity() const { return mean_wheel_; }

 private:
  struct Stretch {
    double start = 0.0;  // [s]
    std::vector<double> sprung, wheel;
  };

  void endBeforeStuckReadings();
  void addSegment(const Stretch& stretch);

  double period_;
  int steps_;
  double mean_wheel_ = 0.0;
  std::vector<Stretch> stretches_;
  std::vector<DriveSegment> segments_;
  Stamp first_{};
  CornerSample last_{};
  std::array<int, 2> repeats_{};  // of the last reading, sprung and unsprung
};

}  // namespace suspension_health_monitor
