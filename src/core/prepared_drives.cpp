#include "prepared_drives.h"

#include <stdexcept>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/fit/rough_strut.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/monitor_settings.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/text.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

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

}  // namespace

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

}  // namespace suspension_health_monitor
