#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

/// Measurement time: nanoseconds since the epoch of the clock that stamped the data. An integer, so that a stamp of
/// today keeps its last nanosecond (a double would round it to about 2e-7 s).
using Stamp = std::chrono::nanoseconds;

/// @return the stamp or interval in [s].
inline double toSeconds(Stamp stamp) { return std::chrono::duration<double>(stamp).count(); }

/// @param seconds  [s], finite and below 2.9e2 years in magnitude.
/// @return the nearest whole nanosecond.
inline Stamp fromSeconds(double seconds) { return std::chrono::round<Stamp>(std::chrono::duration<double>(seconds)); }

/// The sensors of a strut. The road's, where the tyre touches it, is optional.
enum class Side : std::size_t { kSprung = 0, kUnsprung = 1, kRoad = 2 };

/// What the two accelerometers of one strut read at one instant.
///
/// Signs and units of the whole library (z sprung position, w unsprung position, up positive as in REP 103):
///   travel d = w - z [m], compression positive; travel rate v = w' - z' [m/s];
///   sprung acceleration y = z'' [m/s^2]; relative acceleration u = w'' - z'' [m/s^2].
/// A constant common to both readings (gravity: an IMU at rest reads +9.81 on its up axis, REP 145) may stay in them:
/// it cancels in u, and the regression row of y holds second differences only, see SuspensionRegression.
struct CornerSample {
  Stamp stamp{};
  double sprung_acceleration = 0.0;    ///< z'' [m/s^2], body side of the strut
  double unsprung_acceleration = 0.0;  ///< w'' [m/s^2], wheel carrier side of the strut
};

/// What one message of the body's IMU tells besides z'', in the strut's frame: z up along the strut, x and y across it,
/// right-handed.
struct BodyMotion {
  Stamp stamp{};
  std::array<double, 2> acceleration{};  ///< along x, y [m/s^2]; NaN: not measured
  std::array<double, 2> angular_rate{};  ///< about x, y [rad/s]; NaN: not measured
};

/// A low-pass filter that both signals of a drive have passed. The law of a filtered travel is not the filtered law:
/// models are driven by w'' as it was before, and what they predict passes the same filter.
struct LowPass {
  std::vector<double> taps = {};        ///< of an FIR filter that delays nothing: h_-n .. h_n, h_-k = h_k; empty: none
  std::vector<double> unfiltered = {};  ///< w'' before it [m/s^2], one per sample

  /// @param num_samples  of the drive.
  /// @throws std::invalid_argument  if the taps have no middle, or w'' before them is not known at every sample.
  void validate(std::size_t num_samples) const;
};

/// A recorded drive of one strut: what diagnose(), compare() and identify() work on.
struct Drive {
  /// Both accelerometers read at the same instants, `sample_period` apart, in the order of time. Where the stamps are
  /// further apart there is a gap: nothing is computed across it.
  std::vector<CornerSample> samples;
  /// What else the body's IMU measured, if anything, in the order of time, by the clock of the samples. It need not
  /// have their stamps. Only faults of that IMU (tilt, lever arm) are told by it.
  std::vector<BodyMotion> body = {};
  /// What the sensors' noise alone would make of a drive, in any unit; that of the first of several drives is taken for
  /// all. Empty: it is white, and alike in both sensors.
  std::vector<CornerSample> noise = {};
  LowPass low_pass = {};
};

/// Why nothing can be said of some drives.
enum class Shortcoming {
  kNone,
  kNoDampedSpring,   ///< no b1 and b0 above 0 are found: parked, swapped sensors, an axis upside down
  kTooFast,          ///< the model is too stiff for the sampling: more than 32 integration steps per sample
  kTooShort,         ///< too few samples between gaps, or nothing moves
  kNoStableFit,      ///< no stable damped spring fits them; or the model given runs away on them
  kModelUntestable,  ///< the model given has a fault of the body's IMU that needs a channel which is not measured
};

/// A drive without gaps.
/// @param period  sampling time T [s], in [1e-5, 10].
/// @param sprung_acceleration, unsprung_acceleration  z'' and w'' [m/s^2], of equal length.
/// @throws std::invalid_argument  if the lengths differ or the period is none of a sensor.
Drive makeDrive(double period, const std::vector<double>& sprung_acceleration,
                const std::vector<double>& unsprung_acceleration);

/// @return the median spacing of the samples of all drives [s].
/// @throws std::invalid_argument  if no drive has two samples, or the median is not above 0.
double medianPeriod(const std::vector<Drive>& drives);

}  // namespace suspension_health_monitor
