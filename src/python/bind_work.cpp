// What the functions of the Python module do with arrays.
#include <stdexcept>

#include "bindings.h"
#include "options.h"
#include "results.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/signal/tuning.h"
#include "suspension_health_monitor/internal/vehicle/rough_strut.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {
namespace {

/// @return readings of all.
std::size_t sizeOf(const Recordings& recordings) {
  std::size_t sum = 0;
  for (const Recording& recording : recordings)
    for (const auto& [stamps, values] : recording.streams) sum += static_cast<std::size_t>(stamps.size());
  return sum;
}

std::optional<double> spacingOf(const Recordings& recordings) {
  PeriodMeasurement measurement(PeriodMeasurement::kFewestOfRecording);
  for (const Recording& recording : recordings)
    recording.forEach([&](Side side, Stamp stamp, double) { measurement.add(side, stamp); });
  return measurement.period();
}

/// @return what is to be added to all stamps so that none is 0 or less: stamp 0 means that a driver has set none.
Stamp shiftOf(const Recordings& recordings) {
  constexpr Stamp kFirst(1);
  Stamp earliest = kFirst;
  for (const Recording& recording : recordings)
    for (const auto& [stamps, values] : recording.streams)
      if (stamps.size() > 0) earliest = std::min(earliest, Stamp(*stamps.data()));
  return kFirst - earliest;
}

/// @throws std::invalid_argument  if a sample_period is given that is far below the spacing of the stamps.
void requireFittingPeriod(const Recordings& recordings, const MonitorOptions& options) {
  if (!options.sample_period) return;
  const std::string short_period = describeShortPeriod(*options.sample_period, spacingOf(recordings));
  if (!short_period.empty()) throw std::invalid_argument(short_period);
}

/// @return T [s]: as it was given, or the mean spacing of the stamps.
/// @throws std::invalid_argument  as requireFittingPeriod(), or if there are too few stamps to tell.
double periodOf(const Recordings& recordings, const MonitorOptions& options) {
  requireFittingPeriod(recordings, options);
  if (options.sample_period) return *options.sample_period;
  const std::optional<double> period = spacingOf(recordings);
  if (!period) throw std::invalid_argument(describeNoPeriod("of one of the sensors", sizeOf(recordings)));
  MonitorOptions measured;
  measured.sample_period = period;
  validate(measured, kMonitorFields);
  return *period;
}

/// @return what the body's IMU measures across the strut; empty: nothing.
std::vector<BodyMotion> bodyMotion(const Recording& recording, Stamp shift) {
  std::vector<BodyMotion> motion;
  if (!recording.across) return motion;
  const auto rows = recording.across->unchecked<2>();
  const std::int64_t* stamps = recording.streams.front().first.data();
  for (Py_ssize_t k = 0; k < rows.shape(0); ++k) {
    const Stamp stamp = Stamp(stamps[k]) + shift;
    if (!motion.empty() && stamp <= motion.back().stamp) continue;
    motion.push_back({stamp, {rows(k, 0), rows(k, 1)}, {rows(k, 2), rows(k, 3)}});
  }
  return motion;
}

/// @return the samples of a strut, one drive for each recording, aligned as the live monitor aligns them.
std::vector<Drive> toDrives(const Recordings& recordings, const MonitorOptions& options, double period, Stamp shift,
                            LongWork& work) {
  std::vector<Drive> drives;
  for (const Recording& recording : recordings) {
    Drive& drive = drives.emplace_back();
    VehicleGrid grid(period, VehicleStreams(VehicleLayout::ofOneStrut(false)), MonitorSettings(options).grid(period),
                     [&](const VehicleSample& sample) { drive.samples.push_back(sample.ofStrut(0)); });
    drive.body = bodyMotion(recording, shift);
    recording.forEach([&](Side side, Stamp stamp, double value) {
      if (side == Side::kRoad) return;
      work.step();
      if (grid.push(indexOf(side), stamp + shift, &value)) dropNewest(drive.samples, kSignalTuning.outcomes);
    });
  }
  return drives;
}

/// Calls take(side, stamp + shift, value) with every reading and finish() after every recording, and tells how much is
/// done.
template <class Take, class Finish>
void forEachReading(const Recordings& recordings, Stamp shift, LongWork& work, const Take& take, const Finish& finish) {
  const auto all = static_cast<double>(sizeOf(recordings));
  double done = 0.0;
  for (const Recording& recording : recordings) {
    recording.forEach([&](Side side, Stamp stamp, double value) {
      take(side, stamp + shift, value);
      work.step(++done / all);
    });
    finish();
  }
}

/// @param judge  makes a result of drives and options: compare() or diagnose().
/// @param judging  its options, all but those that are given here.
/// @return the result.
/// @throws std::invalid_argument  as periodOf(), or saying why there is none.
template <class Judge, class Options>
auto judgeArrays(const Judge& judge, const Recordings& recordings, const MonitorOptions& options, Options judging,
                 LongWork& work) {
  const double period = periodOf(recordings, options);
  judging.sample_period = period;
  if (options.integration_horizon) judging.horizon_samples = MonitorSettings(options).horizonSamples(period);
  judging.progress = work.callback();
  auto result = judge(toDrives(recordings, options, period, shiftOf(recordings), work), judging);
  if (!result) throw std::invalid_argument("the drives " + result.reason);
  return result;
}

/// @throws std::invalid_argument  saying why, if the readings have not given one regression row.
const SuspensionMonitor& monitorOf(const VehiclePipeline& made) {
  if (made.strut() == nullptr)
    throw std::invalid_argument(describeNoStart("of one of the sensors") + describeRejected(made.rejected()));
  const std::string nothing = describeNoRow(*made.strut(), made.grid()->streams(), made.rejected());
  if (!nothing.empty()) throw std::invalid_argument(nothing);
  return *made.strut();
}

Identification identifyArrays(const Recordings& recordings, const OptionMap& keywords,
                              const std::optional<StrutModel>& model, LongWork& work) {
  MonitorOptions options = arrayOptions(keywords).monitor;
  const double period = periodOf(recordings, options);
  const Stamp shift = shiftOf(recordings);
  options.sample_period = period;
  options.tyre = recordings.front().streams.size() > indexOf(Side::kRoad);
  const bool is_given = options.integration_horizon.has_value();
  if (!is_given)
    if (const auto rough = roughStrut(toDrives(recordings, options, period, shift, work), period))
      options.integration_horizon = rough->horizonSamples(period) * period;
  Course course(shift);
  VehiclePipeline made(options, [&](const MonitorReport& report) { course.add(report); });
  if (model) made.setEffects(model->effects, model->linearPart());
  const auto take = [&](Side side, Stamp stamp, double value) { made.push(side, stamp, value); };
  forEachReading(recordings, shift, work, take, [] {});
  const IdentifyResult result = identified(monitorOf(made), made.overTheDrive(), made.rejected());
  if (!is_given && !options.integration_horizon && !result.estimate.valid() && !result.now.valid())
    throw std::invalid_argument("no estimate is valid: " + describe(result.estimate.doubt) +
                                describeSuspicions(made.strut()->report(), &made.grid()->streams()) +
                                "; give integration_horizon to look at them all the same");
  Identification found = Identification::of(result, made, 0, course);
  found.change = describeChange(found, nominalOf(options), options);
  return found;
}

HealthSummary watchArrays(const Recordings& recordings, const OptionMap& keywords,
                          const std::optional<Baseline>& healthy, const std::string& file, LongWork& work) {
  PipelineOptions options = arrayOptions(keywords);
  options.monitor.tyre = false;
  requireFittingPeriod(recordings, options.monitor);
  const Stamp shift = shiftOf(recordings);
  HealthLog log(fromSeconds(options.shell.input_timeout), {"the body's sensor", "the wheel carrier's sensor"});
  Course course(shift);
  VehiclePipeline strut(options.monitor, [&](const MonitorReport& report) {
    log.addReport(report);
    course.add(report);
  });
  if (healthy) strut.setBaseline(*healthy);
  const auto take = [&](Side side, Stamp stamp, double value) {
    if (side == Side::kRoad) return;
    log.addReading(indexOf(side), stamp, stamp);
    strut.push(side, stamp, value);
  };
  forEachReading(recordings, shift, work, take, [&] { log.finishRecording(); });
  return HealthSummary::of(log, monitorOf(strut), healthy ? std::optional(file) : std::nullopt, strut.rejected(),
                           course);
}

Comparison compareArrays(const Recordings& recordings, const OptionMap& keywords,
                         const std::optional<StrutModel>& model, LongWork& work) {
  CompareOptions comparing;
  comparing.model = model;
  comparing.fit = !model;
  return judgeArrays(&compare, recordings, arrayOptions(keywords).monitor, comparing, work);
}

SearchedStrut diagnoseArrays(const Recordings& recordings, const OptionMap& keywords,
                             const std::optional<StrutModel>& model, const EffectLibrary& candidates, int threads,
                             LongWork& work) {
  const MonitorOptions options = arrayOptions(keywords).monitor;
  DiagnoseOptions searching;
  searching.model = model;
  searching.candidates = candidates;
  searching.threads = threads;
  const auto search = [&](const std::vector<Drive>& drives, const DiagnoseOptions& its) {
    SearchedStrut found{diagnose(drives, its), ""};
    if (!found) return found;
    found.change = describeChange(drives, its, nominalOf(options), options);
    found.curves = strutCurves(drives, found.model(), its.sample_period);
    found.travel = travelStatistics(drives, found.model(), its.sample_period);
    return found;
  };
  return judgeArrays(search, recordings, options, searching, work);
}

}  // namespace

void bindWork(py::module& module) {
  defWork<Recordings, OptionMap, std::optional<StrutModel>>(module, "identify", &identifyArrays, "recordings",
                                                            "keywords", "model");
  defWork<Recordings, OptionMap, std::optional<Baseline>, std::string>(module, "health", &watchArrays, "recordings",
                                                                       "keywords", "baseline", "file");
  defWork<Recordings, OptionMap, std::optional<StrutModel>>(module, "compare", &compareArrays, "recordings", "keywords",
                                                            "model");
  defWork<Recordings, OptionMap, std::optional<StrutModel>, EffectLibrary, int>(
      module, "diagnose", &diagnoseArrays, "recordings", "keywords", "model", "candidates", "threads");
}

}  // namespace suspension_health_monitor
