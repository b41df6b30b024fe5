#include <stdexcept>

#include "bindings.h"
#include "options.h"
#include "readings.h"
#include "results.h"
#include "suspension_health_monitor/internal/fit/rough_strut.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

double proposeHorizon(const Recordings& recordings, const MonitorOptions& options, double period, Stamp shift,
                      LongWork& work) {
  const std::vector<Drive> drives = toDrives(recordings, options, period, shift, work);
  if (const auto rough = roughStrut(drives, period)) return rough->horizonSamples(period) * period;
  UniformGrid grid(period, MonitorSettings(options).grid(period));
  recordings.front().forEach([&](Side side, Stamp stamp, double value) {
    if (side == Side::kRoad) return;
    for (auto sample = grid.push(side, stamp + shift, value); sample;) sample = grid.next();
  });
  throw std::invalid_argument("no horizon can be proposed: the data show no damped spring" +
                              describeSuspicions(grid, drives, period) +
                              "; give integration_horizon to look at them all the same");
}

Identification identify(const Recordings& recordings, MonitorOptions options, const std::optional<StrutModel>& model,
                        LongWork& work) {
  const double period = periodOf(recordings, options);
  const Stamp shift = shiftOf(recordings);
  options.sample_period = period;
  options.tyre = recordings.front().hasRoad();
  if (!options.integration_horizon)
    options.integration_horizon = proposeHorizon(recordings, options, period, shift, work);
  Course course(shift);
  const auto keep = [&](const MonitorReport& report) {
    if (report.has_row) course.add(report);
  };
  StrutPipeline made(options, {keep, {}});
  if (model) made.setEffects(model->effects);
  const auto take = [&](Side side, Stamp stamp, double value) { made.push(side, stamp, value); };
  forEachReading(recordings, shift, work, take, [] {});
  Identification found = Identification::of(made, made.rejected(), course);
  found.change = describeChange(found, nominalOf(options), options);
  return found;
}

}  // namespace

void bindIdentification(py::module& module) {
  py::class_<IdentifiedStrut>(module, "IdentifiedStrut", "What one estimator knows of the strut; NaN: nothing.")
      .def_readonly("damping_to_mass", &IdentifiedStrut::damping_to_mass, "b1 = damping/mass [1/s]")
      .def_readonly("stiffness_to_mass", &IdentifiedStrut::stiffness_to_mass, "b0 = stiffness/mass [1/s^2]")
      .def_readonly("damping_to_mass_stddev", &IdentifiedStrut::damping_to_mass_stddev, "[1/s]")
      .def_readonly("stiffness_to_mass_stddev", &IdentifiedStrut::stiffness_to_mass_stddev, "[1/s^2]")
      .def_readonly("rows", &IdentifiedStrut::rows, "regression rows, or blocks, that the estimate rests on")
      .def_readonly("explained", &IdentifiedStrut::explained, "share of the body's motion that the strut explains")
      .def_readonly("age", &IdentifiedStrut::age, "of the newest data behind estimate [s]; else NaN")
      .def_readonly("valid", &IdentifiedStrut::valid)
      .def_readonly("reason", &IdentifiedStrut::reason, "why it is not valid; empty if it is")
      .def_property_readonly("natural_frequency", &IdentifiedStrut::naturalFrequency, "undamped [Hz]")
      .def_property_readonly("damping_ratio", &IdentifiedStrut::dampingRatio, "[-]");
  py::class_<Identification>(module, "Identification", "A strut identified from recorded drives.")
      .def_readonly("sample_period", &Identification::sample_period, "T [s]")
      .def_readonly("horizon_samples", &Identification::horizon_samples, "L of the integral filter")
      .def_readonly("estimate", &Identification::estimate, "over the whole drive: what to trust")
      .def_readonly("now", &Identification::now, "the same at the end of the drive, as the live monitor has it")
      .def_readonly("ls", &Identification::ls, "at the end of the drive, by least squares")
      .def_readonly("la", &Identification::la, "the same by the least sum of absolute values")
      .def_readonly("iv", &Identification::estimate, "estimate, by its former name, until the next version")
      .def_readonly("samples", &Identification::samples, "taken in")
      .def_readonly("rows", &Identification::rows, "regression rows that they gave")
      .def_readonly("gaps", &Identification::gaps)
      .def_readonly("clock_jumps", &Identification::clock_jumps)
      .def_readonly("rejected", &Identification::rejected, "readings that were kept out, by reason")
      .def_readonly("warnings", &Identification::warnings, "of sensors and stamps, in words")
      .def_readonly("mean_period", &Identification::mean_period, "of uninterrupted samples [s]")
      .def_readonly("alignment", &Identification::alignment, "how readings became samples, in words")
      .def_readonly("bridged", &Identification::bridged, "samples made of readings around a gap")
      .def_readonly("tyre", &Identification::tyre, "of a recording with a road sensor, else None")
      .def_readonly("sprung_mass", &Identification::sprung_mass, "[kg], as it was given, or None")
      .def_readonly("change", &Identification::change, "against nominal values, in a sentence; empty: none are given")
      .def_readonly("course", &Identification::course, "estimates over time");
  module.def(
      "identify",
      [](const Recordings& recordings, const Keywords& keywords, const std::optional<StrutModel>& model,
         const py::object& progress) {
        const ArrayOptions options = ArrayOptions::from(keywords.values);
        LongWork work(progress);
        return work.run([&] { return identify(recordings, options.monitor, model, work); });
      },
      py::arg("recordings"), py::arg("keywords"), py::arg("model"), py::arg("progress"));
}

}  // namespace suspension_health_monitor
