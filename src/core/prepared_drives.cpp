#include "prepared_drives.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/internal/fit/rough_model.h"
#include "suspension_health_monitor/internal/identification/clock_lag.h"
#include "suspension_health_monitor/internal/identification/horizon_survey.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/monitor_settings.h"
#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/record/untestable_effects.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

double periodOf(const std::vector<Drive>& drives, const std::optional<double>& sample_period) {
  if (drives.empty()) throw std::invalid_argument("no drive is given, must be one or more");
  if (!sample_period) return medianPeriod(drives);
  if (!(*sample_period > 0.0 && std::isfinite(*sample_period)))
    throw std::invalid_argument("sample_period = " + numberText(*sample_period) + " [s], must be above 0");
  return *sample_period;
}

StrutModel roughStart(const std::vector<Drive>& drives, double period, std::optional<int> horizon_samples) {
  if (horizon_samples && !(*horizon_samples >= 1 && *horizon_samples <= kMostHorizonSamples))
    throw std::invalid_argument("horizon_samples = " + std::to_string(*horizon_samples) + ", must be in [1, " +
                                std::to_string(kMostHorizonSamples) + "]");
  if (!horizon_samples) horizon_samples = surveyHorizon(drives, period, HorizonSurvey::kEnough);
  if (!horizon_samples) return {};
  IntegralFilterOptions filter;
  filter.period = period;
  filter.horizon_samples = *horizon_samples;
  return roughModel(drives, filter);
}

PreparedDrives lacking(Shortcoming shortcoming, const StrutModel& start) {
  return {shortcoming, reasonOf(shortcoming, start), start, {}, std::nullopt};
}

}  // namespace

PreparedDrives prepareDrives(const std::vector<Drive>& drives, const std::optional<double>& sample_period,
                             const std::optional<int>& horizon_samples, const std::optional<StrutModel>& model) {
  const double period = periodOf(drives, sample_period);
  for (const Drive& drive : drives) drive.low_pass.validate(drive.samples.size());
  if (model) requireUsable(model->effects);
  StrutModel start = model ? *model : roughStart(drives, period, horizon_samples);
  const std::optional<LaggedStrut> lagged = model ? std::nullopt : lookForClockLag(drives, period);
  if (lagged && !isDampedSpring(start))
    start = {lagged->model.damping_to_mass, lagged->model.stiffness_to_mass, {}, {}};
  // What a fit leaves to the linear damping may be less than nothing where an effect of the model damps.
  const bool is_spring = model ? start.stiffness_to_mass > 0.0 : isDampedSpring(start);
  if (!is_spring) return lacking(Shortcoming::kNoDampedSpring, start);
  if (!canFollow(start, period)) return lacking(Shortcoming::kTooFast, start);
  PreparedDrives prepared{Shortcoming::kNone, "", start, makeRecords(drives, period, start), std::nullopt};
  if (lagged) prepared.lagged = lagged->model;
  const std::optional<UntestableEffect> untestable = findUntestable(start, pointersTo(prepared.records));
  if (!untestable) return prepared;
  PreparedDrives refused = lacking(Shortcoming::kModelUntestable, start);
  refused.reason = "do not tell " + untestable->name + ", which the model has: " + reasonOf(untestable->missing);
  return refused;
}

}  // namespace suspension_health_monitor
