#pragma once

#include <boost/hana/adapt_struct.hpp>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/compare/travel_statistics.h"
#include "suspension_health_monitor/internal/wording/health_log.h"
#include "suspension_health_monitor/monitor_report.h"

// The fields of results that users see: keys of JSON and attributes in Python, by the names that they have here. Values
// that are computed, and those that users know by another name, are added where they are shown.

namespace shm = suspension_health_monitor;

BOOST_HANA_ADAPT_STRUCT(shm::DryFriction, force, stddev, damping_gain);
BOOST_HANA_ADAPT_STRUCT(shm::DamperTemperature, celsius, per_kelvin, per_kelvin_stddev);
BOOST_HANA_ADAPT_STRUCT(shm::StrutEstimate, damping_to_mass, stiffness_to_mass, damping_to_mass_stddev,
                        stiffness_to_mass_stddev, correlation, offset, delay, delay_stddev, gain, gain_stddev, friction,
                        explained, age, window);
BOOST_HANA_ADAPT_STRUCT(shm::WheelEstimate, damping_to_wheel_mass, stiffness_to_wheel_mass, tyre_to_wheel_mass,
                        damping_to_wheel_mass_stddev, stiffness_to_wheel_mass_stddev, tyre_to_wheel_mass_stddev);
BOOST_HANA_ADAPT_STRUCT(shm::TyreReport, ls, la);
BOOST_HANA_ADAPT_STRUCT(shm::ComparisonReport, measured, predicted, rmse, fit_percent, base_rmse, base_fit_percent);
BOOST_HANA_ADAPT_STRUCT(shm::HealthReport, level, damping_change, stiffness_change, payload_change, early_warning,
                        learning);
BOOST_HANA_ADAPT_STRUCT(shm::MonitorReport, stamp, estimate, ls, la, comparison, health);
BOOST_HANA_ADAPT_STRUCT(shm::InputStatus, samples, rows, gaps, mean_period, period_fits, unit_fits);
BOOST_HANA_ADAPT_STRUCT(shm::Baseline, damping_to_mass, stiffness_to_mass, damping_to_mass_stddev,
                        stiffness_to_mass_stddev, damping_scatter, stiffness_scatter, friction, temperature, learned);
BOOST_HANA_ADAPT_STRUCT(shm::HealthMoment, time, elapsed, level, message);

BOOST_HANA_ADAPT_STRUCT(shm::IdentifyResult, samples, rows, gaps, clock_jumps, sample_period, horizon_samples,
                        warnings);

BOOST_HANA_ADAPT_STRUCT(shm::EffectLibrary::Description, name, law, kind, coefficients, shapes, finding, advice);
BOOST_HANA_ADAPT_STRUCT(shm::ModelNumber, name, effect, symbol, unit, value);
BOOST_HANA_ADAPT_STRUCT(shm::StrutModel, damping_to_mass, stiffness_to_mass);
BOOST_HANA_ADAPT_STRUCT(shm::FittedModel, model, stddev, all_samples);
BOOST_HANA_ADAPT_STRUCT(shm::RankedModel, effects, model, fitted, held_out_rmse, error_removed_percent, significance,
                        significant);
BOOST_HANA_ADAPT_STRUCT(shm::Diagnosis, verdict, noise_floor, structured_share, surface_share, suggested_drive,
                        selected, indistinguishable);

BOOST_HANA_ADAPT_STRUCT(shm::TimeHistogram::Direction, share, mean, largest);
BOOST_HANA_ADAPT_STRUCT(shm::TimeHistogram, edges, shares, compression, rebound);
BOOST_HANA_ADAPT_STRUCT(shm::StopUse, effect, gap, near, hits);
BOOST_HANA_ADAPT_STRUCT(shm::TravelStatistics, travel, travel_rate, stops);

BOOST_HANA_ADAPT_STRUCT(shm::ResidualBin, from, to, mean, standard_error, rms, count);
BOOST_HANA_ADAPT_STRUCT(shm::TimeBin, from, to, mean, standard_error, rms, count, drive, damping_error,
                        damping_error_stddev, stiffness_error, stiffness_error_stddev);
BOOST_HANA_ADAPT_STRUCT(shm::ForceSurface, travel_edges, rate_edges, mean, standard_error, rms, count, explained_share);
BOOST_HANA_ADAPT_STRUCT(shm::DirectionLoop, compressing, extending, gap, gap_standard_error, area);
BOOST_HANA_ADAPT_STRUCT(shm::ResidualSpectrum, frequency, residual, measured, noise, coherence, coherence_threshold);
BOOST_HANA_ADAPT_STRUCT(shm::ResidualCorrelation, lag, value, lower, upper, share_outside, within);
BOOST_HANA_ADAPT_STRUCT(shm::ResidualViews, offset, offset_standard_error, rms, num_samples, time, travel, travel_rate,
                        surface, direction, spectrum, whiteness, cross_correlation);
BOOST_HANA_ADAPT_STRUCT(shm::FailureRegion, region, sentence, rmse, rmse_elsewhere, mean, share);
BOOST_HANA_ADAPT_STRUCT(shm::PredictionError, rmse, fit_percent);
BOOST_HANA_ADAPT_STRUCT(shm::ComparedSegment, drive, period, measured, predicted, wheel, travel, travel_rate,
                        added_force, missing_force);
BOOST_HANA_ADAPT_STRUCT(shm::Comparison, model, stddev, free_run, held_out_rmse, one_step, horizon_samples, noise_floor,
                        structured_share, where, views, segments);
