#pragma once

#include <algorithm>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {

/// Estimates what the noise of both sensors leaves of a free run [m/s^2], without knowing the model's faults.
///
/// The noise of the body's sensor is what a long linear interpolation of z'' from its own neighbours before and after,
/// and from w'' around it, cannot tell: forces that are missing from the model change slowly against the sampling and
/// are interpolated, white noise is not. Those that change quickly (friction turns within a sample) are taken out: a
/// free-form force over the travel and rate of the model's free run is fitted to what the interpolation leaves. From
/// the median, so that a blow into an end stop is no noise, and with such blows kept out of the fits. The wheel's
/// sensor is taken to be as noisy; its noise comes through the model. Where the records have what the noise looks like,
/// that tells it (known_noise.h).
/// @return 0 if there are too few samples to tell; not below accuracyOfFreeRuns().
double estimateNoiseFloor(const Records& records, const StrutModel& model);

/// What sampling loses of a model's own forces [m/s^2]: the rms of what the same interpolation cannot tell of the z''
/// that the model predicts, in which no sensor has noise. The wheel's samples lose as much, which comes through the
/// model. Next to nothing of what is linear; a model with corners, as friction and stops have, cannot be asked to leave
/// less beside the noise, since nothing tells it where between two samples they were.
double lostInSampling(const Records& records, const ModelFit& fit);

/// What a free run of the true model leaves where no sensor has noise: the interpolation of w'' is not exact [m/s^2].
double accuracyOfFreeRuns(const Records& records);

/// @return 1 - floor^2 / rmse^2, not below 0: the share of a mean square that is not noise.
inline double structuredShare(double rmse, double noise_floor) {
  return rmse > 0.0 ? std::max(0.0, 1.0 - square(noise_floor / rmse)) : 0.0;
}

/// What is left counts as noise up to this share: a floor that is estimated 10 % too low makes 0.2 of it out of noise.
inline constexpr double kStructured = 0.2;

inline bool isStructured(double rmse, double noise_floor) { return structuredShare(rmse, noise_floor) >= kStructured; }

}  // namespace suspension_health_monitor
