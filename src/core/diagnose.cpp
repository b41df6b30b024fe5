#include "suspension_health_monitor/diagnose.h"

#include <algorithm>
#include <deque>
#include <stdexcept>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/compare/travel_statistics.h"
#include "suspension_health_monitor/internal/fit/curve_fit.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/record/motion.h"
#include "suspension_health_monitor/internal/vehicle/rough_strut.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

/// What the facades start from.
struct PreparedDrives {
  Shortcoming shortcoming = Shortcoming::kNone;
  std::string reason;                             ///< to be read after "the drives"
  StrutModel start;                               ///< the model given, or a rough one by blocks
  std::deque<DriveRecord> records;                ///< one per drive; none if there is a shortcoming
  std::optional<StrutModel> lagged = {};          ///< a rough one with clock_offset, if the clocks seem to differ
  std::optional<MotionRange> one_frequency = {};  ///< if all motion is at one
};

double periodOf(const std::vector<Drive>& drives, const std::optional<double>& sample_period) {
  if (drives.empty()) throw std::invalid_argument("no drive is given, must be one or more");
  if (!sample_period) return medianPeriod(drives);
  requireAboveZero("sample_period", *sample_period, "s");
  return *sample_period;
}

// A horizon that is given tells how long the first blocks have to be.
std::optional<RoughStrut> roughStart(const std::vector<Drive>& drives, double period,
                                     const std::optional<int>& horizon_samples) {
  if (horizon_samples) requireIn("horizon_samples", *horizon_samples, "", 1.0, kMostHorizonSamples);
  MonitorSettings settings;
  if (horizon_samples) settings.integration_horizon = *horizon_samples * period;
  return roughStrut(drives, period, settings.presentBlockLength());
}

std::optional<MotionRange> oneFrequency(const std::deque<DriveRecord>& records) {
  const std::optional<MotionRange> range = rangeOfMotion(pointersTo(records));
  return range && range->isOneFrequency() ? range : std::nullopt;
}

PreparedDrives lacking(Shortcoming shortcoming, const StrutModel& start) {
  return {shortcoming, reasonOf(shortcoming, start), start, {}};
}

/// Settings (DiagnoseOptions or CompareOptions) -> period, horizon, rough model, records with the body's motion; and
/// whether all of that is fit for free runs.
/// @param model  nothing: the linear strut.
/// @throws std::invalid_argument  for a period that is not above 0, a horizon below 1, or no drive.
PreparedDrives prepareDrives(const std::vector<Drive>& drives, const std::optional<double>& sample_period,
                             const std::optional<int>& horizon_samples, const std::optional<StrutModel>& model) {
  const double period = periodOf(drives, sample_period);
  for (const Drive& drive : drives) drive.low_pass.validate(drive.samples.size());
  if (model) requireUsable(model->effects);
  const std::optional<RoughStrut> rough = model ? std::nullopt : roughStart(drives, period, horizon_samples);
  StrutModel start = model.value_or(StrutModel());
  if (rough) start = {rough->strut.damping_to_mass, rough->strut.stiffness_to_mass, {}, {}};
  // What a fit leaves to the linear damping may be less than nothing where an effect of the model damps.
  if (!(start.stiffness_to_mass > 0.0)) {
    PreparedDrives refused = lacking(Shortcoming::kNoDampedSpring, start);
    if (const auto range = oneFrequency(makeRecords(drives, period, StrutModel())))
      refused.reason += ". " + describe(*range);
    return refused;
  }
  if (!canFollow(start, period)) return lacking(Shortcoming::kTooFast, start);
  PreparedDrives prepared{Shortcoming::kNone, "", start, makeRecords(drives, period, start)};
  prepared.one_frequency = oneFrequency(prepared.records);
  if (!prepared.one_frequency && rough && rough->clocksDiffer(period)) {
    prepared.lagged = start;
    prepared.lagged->reading.push_back({findEffect(measurementEffects(), "clock_offset"), {rough->clock_offset}});
  }
  const auto untestable = findUntestable(start, pointersTo(prepared.records));
  if (!untestable) return prepared;
  PreparedDrives refused = lacking(Shortcoming::kModelUntestable, start);
  refused.reason = "do not tell " + untestable->first + ", which the model has: " + reasonOf(untestable->second);
  return refused;
}

}  // namespace

Diagnosis diagnose(const std::vector<Drive>& drives, const DiagnoseOptions& options) {
  if (options.threads < 1) refuse("threads", options.threads, "", "1 or more");
  const PreparedDrives prepared = prepareDrives(drives, options.sample_period, options.horizon_samples, options.model);
  SearchResult result;
  result.shortcoming = prepared.shortcoming;
  result.reason = prepared.reason;
  if (!result) return result;

  const Records records = pointersTo(prepared.records);
  DiagnoseOptions searched = options;
  const auto untestable = takeUntestable(searched.candidates, records);
  std::vector<std::string> of_frequency;
  if (prepared.one_frequency) of_frequency = takeFrequencyResponses(searched.candidates);
  result = searchEffects(records, prepared.start, searched, prepared.lagged);
  result.reason = reasonOf(result.shortcoming, prepared.start);
  if (!result) return result;
  result.one_frequency = prepared.one_frequency;
  if (result.one_frequency && result.verdict == Verdict::kEffectFound) result.verdict = Verdict::kSuspect;
  result.summary = summaryOf(result);
  result.remainder = remainderOf(result);
  result.suggested_drive = suggestionOf(result);
  for (const auto& [name, missing] : untestable) result.not_tried.emplace_back(name, reasonOf(missing));
  for (const std::string& name : of_frequency) result.not_tried.emplace_back(name, kOneFrequency);
  const auto has_samples = [](const Drive& drive) { return !drive.samples.empty(); };
  result.from = std::find_if(drives.begin(), drives.end(), has_samples)->samples.front().stamp;
  result.to = std::find_if(drives.rbegin(), drives.rend(), has_samples)->samples.back().stamp;
  return result;
}

Comparison compare(const std::vector<Drive>& drives, const CompareOptions& options) {
  const PreparedDrives prepared = prepareDrives(drives, options.sample_period, options.horizon_samples, options.model);
  Comparison comparison;
  comparison.shortcoming = prepared.shortcoming;
  comparison.reason = prepared.reason;
  if (!comparison) return comparison;
  comparison = compareModel(pointersTo(prepared.records), prepared.start, options);
  comparison.reason = reasonOf(comparison.shortcoming, prepared.start);
  if (comparison) describeFailures(comparison.views, comparison.noise_floor, comparison.where);
  return comparison;
}

StrutCurves strutCurves(const std::vector<Drive>& drives, const StrutModel& model,
                        const std::optional<double>& sample_period, const std::array<double, 2>& model_error) {
  const PreparedDrives prepared = prepareDrives(drives, sample_period, std::nullopt, model);
  StrutCurves curves = fitCurves(pointersTo(prepared.records), prepared.start);
  curves.damper.model_error = model_error[0];
  curves.spring.model_error = model_error[1];
  return curves;
}

TravelStatistics travelStatistics(const std::vector<Drive>& drives, const StrutModel& model,
                                  const std::optional<double>& sample_period) {
  const PreparedDrives prepared = prepareDrives(drives, sample_period, std::nullopt, model);
  return travelStatistics(pointersTo(prepared.records), prepared.start);
}

}  // namespace suspension_health_monitor
