#pragma once

#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <type_traits>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/compare/travel_statistics.h"
#include "suspension_health_monitor/internal/wording/health_log.h"
#include "suspension_health_monitor/monitor_report.h"

// The fields of results that users see: keys of JSON and attributes in Python, by the names that they have here. Values
// that are computed, and those that users know by another name, are added where they are shown.

// As BOOST_HANA_ADAPT_STRUCT, whose tuples took the compiler as long as what uses them.
#define SHM_VISIT_FIELD(r, Result, field) visit(BOOST_PP_STRINGIZE(field), &Result::field);
#define SHM_FIELDS(Result, ...)                                                             \
  template <>                                                                               \
  struct Fields<Result> : std::true_type {                                                  \
    template <class Visit>                                                                  \
    static void forEach(const Visit& visit) {                                               \
      BOOST_PP_SEQ_FOR_EACH(SHM_VISIT_FIELD, Result, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__)) \
    }                                                                                       \
  };

namespace suspension_health_monitor {

/// Whether the fields of a result are listed here. If so, forEach(visit) calls visit(name, pointer to the member) for
/// each, in this order.
template <class Result>
struct Fields : std::false_type {};

SHM_FIELDS(DryFriction, force, stddev, damping_gain)
SHM_FIELDS(DamperTemperature, celsius, per_kelvin, per_kelvin_stddev)
SHM_FIELDS(StrutEstimate, damping_to_mass, stiffness_to_mass, damping_to_mass_stddev, stiffness_to_mass_stddev,
           correlation, offset, delay, delay_stddev, gain, gain_stddev, friction, explained, age, window)
SHM_FIELDS(WheelEstimate, damping_to_wheel_mass, stiffness_to_wheel_mass, tyre_to_wheel_mass,
           damping_to_wheel_mass_stddev, stiffness_to_wheel_mass_stddev, tyre_to_wheel_mass_stddev)
SHM_FIELDS(TyreReport, ls, la)
SHM_FIELDS(ComparisonReport, measured, predicted, rmse, fit_percent, base_rmse, base_fit_percent)
SHM_FIELDS(HealthReport, level, damping_change, stiffness_change, payload_change, early_warning, learning)
SHM_FIELDS(MonitorReport, stamp, estimate, ls, la, comparison, health)
SHM_FIELDS(InputStatus, samples, rows, gaps, mean_period, period_fits, unit_fits)
SHM_FIELDS(Baseline, damping_to_mass, stiffness_to_mass, damping_to_mass_stddev, stiffness_to_mass_stddev,
           damping_scatter, stiffness_scatter, friction, temperature, learned)
SHM_FIELDS(HealthMoment, time, elapsed, level, message)

SHM_FIELDS(IdentifyResult, samples, rows, gaps, clock_jumps, sample_period, horizon_samples, warnings)

SHM_FIELDS(EffectLibrary::Description, name, law, kind, coefficients, shapes, finding, advice)
SHM_FIELDS(ModelNumber, name, effect, symbol, unit, value)
SHM_FIELDS(StrutModel, damping_to_mass, stiffness_to_mass)
SHM_FIELDS(FittedModel, model, stddev, all_samples)
SHM_FIELDS(RankedModel, effects, model, fitted, held_out_rmse, error_removed_percent, significance, significant)
SHM_FIELDS(Diagnosis, verdict, noise_floor, structured_share, surface_share, suggested_drive, selected,
           indistinguishable)

SHM_FIELDS(TimeHistogram::Direction, share, mean, largest)
SHM_FIELDS(TimeHistogram, edges, shares, compression, rebound)
SHM_FIELDS(StopUse, effect, gap, near, hits)
SHM_FIELDS(TravelStatistics, travel, travel_rate, stops)

SHM_FIELDS(ResidualBin, from, to, mean, standard_error, rms, count)
SHM_FIELDS(TimeBin, from, to, mean, standard_error, rms, count, drive, damping_error, damping_error_stddev,
           stiffness_error, stiffness_error_stddev)
SHM_FIELDS(ForceSurface, travel_edges, rate_edges, mean, standard_error, rms, count, explained_share)
SHM_FIELDS(DirectionLoop, compressing, extending, gap, gap_standard_error, area)
SHM_FIELDS(ResidualSpectrum, frequency, residual, measured, noise, coherence, coherence_threshold)
SHM_FIELDS(ResidualCorrelation, lag, value, lower, upper, share_outside, within)
SHM_FIELDS(ResidualViews, offset, offset_standard_error, rms, num_samples, time, travel, travel_rate, surface,
           direction, spectrum, whiteness, cross_correlation)
SHM_FIELDS(PartialResidualBin, at, mean, deviation, law, count)
SHM_FIELDS(FailureRegion, region, sentence, rmse, rmse_elsewhere, mean, share)
SHM_FIELDS(PredictionError, rmse, fit_percent)
SHM_FIELDS(ComparedSegment, drive, period, measured, predicted, wheel, travel, travel_rate, added_force, missing_force)
SHM_FIELDS(Comparison, model, stddev, free_run, held_out_rmse, one_step, horizon_samples, noise_floor, structured_share,
           where, views, segments)

}  // namespace suspension_health_monitor
