#pragma once

#include <algorithm>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Estimates what the noise of both sensors leaves of a free run [m/s^2], without knowing the model's faults.
///
/// The noise of the body's sensor is what a long linear interpolation of z'' from its own neighbours before and after,
/// and from w'' around it, cannot tell: forces that are missing from the model change slowly against the sampling and
/// are interpolated, white noise is not. Those that change quickly (friction turns within a sample) are taken out: a
/// free-form force over the travel and rate of the model's free run is fitted to what the interpolation leaves. From
/// the median, so that a blow into an end stop is no noise, and with such blows kept out of the fits. The wheel's
/// sensor is taken to be as noisy (if not: floorOfResidual()); its noise comes through the model. Where the records
/// have what the noise looks like, that tells it (floorOfKnownNoise()).
/// @return 0 if there are too few samples to tell; not below accuracyOfFreeRuns().
double estimateNoiseFloor(const Records& records, const StrutModel& model);

/// What the noise of all sensors leaves of a free run [m/s^2] where the records have what that noise looks like
/// (DriveRecord::noise()): its spectrum is known but for its size. That is the median over the frequencies of what the
/// model leaves over what it leaves of the noise. A law that the model lacks is at less than half of all frequencies.
/// @param model  its b1 and b0 count for the noise.
/// @return 0 if there is too little to tell, or the model runs away.
double floorOfKnownNoise(const Records& records, const StrutModel& model);

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

/// What noise leaves of a free run.
struct NoiseFloor {
  double rms = 0.0;            ///< [m/s^2]
  double wheel_to_body = 1.0;  ///< variance of the noise of the wheel's sensor over that of the body's
};

/// The noise floor of what a model leaves: all of it if that is noise of a wheel's sensor that is louder than the
/// body's, or noise which a sensor has filtered, white in a band of its own (isStructured()); else as it is given, but
/// not above the rmse.
/// @param residuals  of a fit of the model.  @param wheel  w'', at the same samples.
NoiseFloor floorOfResidual(double rmse, double noise_floor, const Residuals& residuals, const Residuals& wheel,
                           double period, const StrutModel& model);

/// What a wheel that shakes beyond half the sampling rate may leave of a free run [m/s^2]: without a filter before the
/// sampling such motion is folded back, and no model can follow it. It is taken to be white, with the density that w''
/// has just below half the rate, and to pass the strut as it does there.
/// @return 0 if the drives are too short to tell.
double foldedMotion(const Records& records, const StrutModel& model);

/// Above this share of its motion that is folded back a wheel is sampled too slowly for anything to be told.
inline constexpr double kMostFolded = 0.25;

/// @return rms of white motion as dense as that of w'' just below half the rate, over that of w''.
double shareAtSamplingLimit(const Records& records);

}  // namespace suspension_health_monitor
