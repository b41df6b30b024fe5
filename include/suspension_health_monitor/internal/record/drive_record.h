#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/model/strut_integrator.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// An uninterrupted, uniformly sampled stretch of a drive, prepared for free runs.
struct DriveSegment {
  double start = 0.0;            ///< time of its first sample since the start of the drive [s]
  double driven_before = 0.0;    ///< how long the drives before it are [s]
  double period = 0.0;           ///< sampling time T [s]
  int steps = 1;                 ///< integration steps per sample
  std::vector<double> sprung;    ///< z'' less the drive's mean w'' [m/s^2], one per sample
  std::vector<double> unsprung;  ///< w'' less its mean [m/s^2], one per sample
  /// w'' as it drives a model, before what both signals may have been filtered by; and what the wheel does by it, one
  /// per integration step from lead() samples before the first sample to as many after the last.
  std::vector<double> driving;
  std::vector<WheelStep> wheel;
  std::vector<double> taps;   ///< of the filter that predictions are to pass (LowPass)
  std::vector<Stamp> stamps;  ///< one per sample
  BodyChannels body;          ///< what else the body's IMU measured; empty: not measured, or it never changes

  std::size_t size() const { return sprung.size(); }

  /// @return samples that the filter reaches to either side.
  std::size_t lead() const { return taps.size() / 2; }

  /// @return since the start of the drive [s].
  double time(std::size_t sample) const { return start + static_cast<double>(sample) * period; }

  /// @return time as laws count it [s]: on from drive to drive, as wear does.
  double timeDriven(std::size_t sample) const { return driven_before + time(sample); }
};

/// A drive as a whole, kept for comparison and for fits.
///
/// The mean of w'' is taken off both signals: a vehicle stays where it is, so this is gravity and the offset of the
/// wheel's sensor; what the body's sensor has besides stays.
/// A stretch ends at a gap, and where a sensor repeats one value: a reading that is stuck or lost.
/// Samples at the ends of a stretch that the interpolation of w'' and a filter need are not part of it.
/// The body's motion comes to the samples by linear interpolation between its messages. Accelerations lose their mean
/// over the drive. Angular rates are differentiated by the slope of a cubic through the neighbours (least squares), of
/// 2 to 12 on either side: as few as the noise of the rate allows.
class DriveRecord {
 public:
  /// @param period  sampling time T [s].  @param steps  integration steps per sample, >= 1.
  /// @param driven_before  how long the drives before it are [s].
  DriveRecord(const Drive& drive, double period, int steps = 1, double driven_before = 0.0);

  double period() const { return period_; }
  const std::vector<DriveSegment>& segments() const { return segments_; }
  std::size_t numSamples() const;
  double gravity() const { return mean_wheel_; }
  const std::vector<CornerSample>& noise() const { return noise_; }  ///< Drive::noise

 private:
  double period_;
  double mean_wheel_ = 0.0;
  std::vector<DriveSegment> segments_;
  std::vector<CornerSample> noise_;
};

/// Drives of one vehicle and one period, as fits and searches take them.
using Records = std::vector<const DriveRecord*>;

using Segments = std::vector<const DriveSegment*>;

/// @return the segments of all records, one after the other: the order of everything that is kept by segment.
Segments segmentsOf(const Records& records);

/// @return the time from one segment to the next by their stamps [s]; below 0 if the clock began anew.
double restBetween(const DriveSegment& before, const DriveSegment& after);

/// The drives as records, integrated in steps that follow the strut's fastest motion.
/// @param model  a damped spring.
std::deque<DriveRecord> makeRecords(const std::vector<Drive>& drives, double period, const StrutModel& model);

/// @return the addresses of the records.
Records pointersTo(const std::deque<DriveRecord>& records);

/// Takes the effects out of `library` all of whose channels are empty in one of the records. One that is left is
/// enough: the coefficients of the others stay 0.
/// @return their names, and what is empty.
std::vector<std::pair<std::string, BodyChannel>> takeUntestable(EffectLibrary& library, const Records& records);

/// @return a fault of the model with a coefficient that is not 0 and goes with a channel that is empty, if there is
/// one: its name, and that channel.
std::optional<std::pair<std::string, BodyChannel>> findUntestable(const StrutModel& model, const Records& records);

}  // namespace suspension_health_monitor
