// What the functions of the Python module do with arrays.
#include <stdexcept>

#include "bindings.h"
#include "options.h"
#include "readings.h"
#include "results.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/vehicle/rough_strut.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {
namespace {

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
