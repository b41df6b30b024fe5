#include <stdexcept>

#include "bindings.h"
#include "options.h"
#include "readings.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

HealthSummary watch(const Recordings& recordings, const ArrayOptions& options, const std::optional<Baseline>& healthy,
                    const std::string& file, LongWork& work) {
  requireFittingPeriod(recordings, options.monitor);
  const Stamp shift = shiftOf(recordings);
  MonitorOptions its = options.monitor;
  its.tyre = false;
  HealthLog log(fromSeconds(options.input_timeout), {"the body's sensor", "the wheel carrier's sensor"});
  Course course(shift);
  VehiclePipeline strut(its, [&](const MonitorReport& report) {
    log.addReport(report);
    if (report.has_row) course.add(report);
  });
  if (healthy) strut.setBaseline(*healthy);
  const auto take = [&](Side side, Stamp stamp, double value) {
    if (side == Side::kRoad) return;
    log.addReading(indexOf(side), stamp, stamp);
    strut.push(side, stamp, value);
  };
  forEachReading(recordings, shift, work, take, [&] { log.finishRecording(); });
  const SuspensionMonitor* monitor = strut.strut();
  if (monitor == nullptr)
    throw std::invalid_argument(describeNoStart("of one of the sensors") + describeRejected(strut.rejected()));
  const std::string nothing = describeNoRow(*monitor, strut.grid()->streams(), strut.rejected());
  if (!nothing.empty()) throw std::invalid_argument(nothing);
  return HealthSummary::of(log, *monitor, healthy ? std::optional(file) : std::nullopt, strut.rejected(),
                           course, shift);
}

}  // namespace

void bindHealth(py::module& module) {
  py::class_<HealthMoment>(module, "HealthMoment", "What a monitor said at one time.")
      .def_property_readonly(
          "time", [](const HealthMoment& self) { return toSeconds(self.stamp); }, "its stamp [s]")
      .def_property_readonly(
          "elapsed", [](const HealthMoment& self) { return toSeconds(self.elapsed); },
          "time that the recordings have covered until then [s]")
      .def_property_readonly(
          "level", [](const HealthMoment& self) { return nameOf(self.level); }, "OK, WARN, ERROR or STALE")
      .def_readonly("message", &HealthMoment::message, "why");
  py::class_<HealthSummary>(module, "Health", "What the monitor would have said over recorded drives, and when.")
      .def_readonly("events", &HealthSummary::events, "changes of level, in the order of time")
      .def_readonly("early_warnings", &HealthSummary::early_warnings, "when one began")
      .def_readonly("end", &HealthSummary::end, "what is said at the end")
      .def_readonly("seconds", &HealthSummary::seconds, "how long each level held [s]")
      .def_readonly("counts", &HealthSummary::counts, "changes to each level")
      .def_readonly("estimate", &HealthSummary::estimate, "at the end, what the strut is judged by")
      .def_readonly("ls", &HealthSummary::ls, "estimates at the end")
      .def_readonly("la", &HealthSummary::la, "estimates at the end")
      .def_readonly("reference", &HealthSummary::reference, "what the strut was judged by at the end, in words")
      .def_readonly("baseline", &HealthSummary::baseline, "the same; of no use if nothing was given or learned")
      .def_readonly("rejected", &HealthSummary::rejected, "readings that were kept out, by reason")
      .def_readonly("course", &HealthSummary::course, "estimates and level over time");
  module.def(
      "health",
      [](const Recordings& recordings, const Keywords& keywords, const std::optional<Baseline>& healthy,
         const std::string& file, const py::object& progress) {
        const ArrayOptions options = ArrayOptions::from(keywords.values);
        LongWork work(progress);
        return work.run([&] { return watch(recordings, options, healthy, file, work); });
      },
      py::arg("recordings"), py::arg("keywords"), py::arg("baseline"), py::arg("file"), py::arg("progress"));
}

}  // namespace suspension_health_monitor
