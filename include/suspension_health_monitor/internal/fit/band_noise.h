#pragma once

#include "suspension_health_monitor/internal/fit/output_error_fit.h"

namespace suspension_health_monitor {

/// Noise that a sensor has filtered, as most do inside: white within a band, next to nothing beyond it, where an
/// interpolation (noise_floor.h) sees none. What a free run leaves is such noise if it is white within a band of its
/// own, and the same in every quarter of the drives; what a law leaves is strong near resonance and weak elsewhere, or
/// goes with a sweep.
///
/// White noise of both sensors has the spectrum n g(f), g = 1 + |G(f)|^2 for what comes through the model. The largest
/// that fits under the spectrum S of the residual in a band of m frequencies has n = m / sum(g / S), the harmonic mean
/// over frequencies and quarters, which is also what an interpolation of the band would leave (Kolmogorov). The band is
/// where n sum(g) is largest.
/// @param residuals  of a fit of the model.
/// @return its share of the residual's power; 0 if there are too few samples to tell.
double bandNoiseShare(const Residuals& residuals, double period, const StrutModel& model);

/// The noise floor of what a model leaves: all of it if that is white in a band of its own (isStructured()), else as it
/// is given, but not above the rmse.
double floorOfResidual(double rmse, double noise_floor, const Residuals& residuals, double period,
                       const StrutModel& model);

}  // namespace suspension_health_monitor
