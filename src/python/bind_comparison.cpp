#include "bindings.h"
#include "options.h"
#include "readings.h"
#include "suspension_health_monitor/compare.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

void bindSegment(py::module& module) {
  py::class_<ComparedSegment> segment(module, "ComparedSegment",
                                      "A free run beside the measurement between two gaps; one entry per sample.");
  segment.def_readonly("drive", &ComparedSegment::record, "which of the drives, from 0")
      .def_readonly("period", &ComparedSegment::period, "T [s]")
      .def_property_readonly(
          "time",
          [](const ComparedSegment& self) {
            py::array_t<double> time(static_cast<Py_ssize_t>(self.size()));
            double* next = time.mutable_data();
            for (std::size_t k = 0; k < self.size(); ++k) *next++ = self.time(k);
            return time;
          },
          "since the start of the drive [s]");
  defArray(segment, "measured", &ComparedSegment::measured, "z'' less the mean w'' [m/s^2]");
  defArray(segment, "predicted", &ComparedSegment::predicted, "by the free run [m/s^2]");
  defArray(segment, "wheel", &ComparedSegment::wheel, "w'' less its mean [m/s^2]");
  defArray(segment, "travel", &ComparedSegment::travel, "of the free run, compression positive [m]");
  defArray(segment, "travel_rate", &ComparedSegment::travel_rate, "[m/s]");
  defArray(segment, "added_force", &ComparedSegment::added_force, "the effects' part of the model [m/s^2]");
  defArray(segment, "missing_force", &ComparedSegment::missing_force, "what the model lacks, per unit mass [m/s^2]");
}

void bindParts(py::module& module) {
  py::class_<PredictionError>(module, "PredictionError", "How far a prediction is from the measurement.")
      .def_readonly("rmse", &PredictionError::rmse, "[m/s^2]")
      .def_readonly("fit_percent", &PredictionError::fit_percent, "100 is perfect, 0 no better than a constant");
  py::class_<FailureRegion>(module, "FailureRegion", "A part of the drive where the model fails.")
      .def_readonly("region", &FailureRegion::region, "in a few words")
      .def_readonly("sentence", &FailureRegion::sentence, "where, how often, how much, compared with elsewhere")
      .def_readonly("rmse", &FailureRegion::rmse, "[m/s^2]")
      .def_readonly("rmse_elsewhere", &FailureRegion::rmse_elsewhere, "[m/s^2]; 0 if the region is everything")
      .def_readonly("mean", &FailureRegion::mean, "missing force in the region [m/s^2]")
      .def_readonly("share", &FailureRegion::share, "of the samples");
  bindSegment(module);
}

}  // namespace

void bindComparison(py::module& module) {
  bindParts(module);
  py::class_<Comparison>(module, "Comparison", "A model beside the measurement: how good it is, and where it fails.")
      .def_readonly("model", &Comparison::model, "as it was compared")
      .def_readonly("stddev", &Comparison::stddev, "of its numbers, in their order; empty if they were given")
      .def_property_readonly("fitted", [](const Comparison& self) { return !self.stddev.empty(); })
      .def_readonly("free_run", &Comparison::free_run, "z'' predicted from w'' alone")
      .def_readonly("held_out_rmse", &Comparison::held_out_rmse, "on blocks that no fit has seen [m/s^2], or None")
      .def_readonly("one_step", &Comparison::one_step, "rows of the regression with the same numbers, or None")
      .def_readonly("horizon_samples", &Comparison::horizon_samples, "L of these rows")
      .def_readonly("noise_floor", &Comparison::noise_floor, "what sensor noise alone leaves [m/s^2]")
      .def_readonly("structured_share", &Comparison::structured_share, "share of the error that is not noise")
      .def_readonly("where", &Comparison::where, "worst first")
      .def_readonly("views", &Comparison::views)
      .def_readonly("segments", &Comparison::segments, "for plots over time");
  module.def(
      "compare",
      [](const Recordings& recordings, const Keywords& keywords, const std::optional<StrutModel>& model,
         const py::object& progress) {
        const ArrayOptions options = ArrayOptions::from(keywords.values);
        CompareOptions comparing;
        comparing.model = model;
        comparing.fit = !model;
        LongWork work(progress);
        return work.run([&] { return judgeArrays(&compare, recordings, options.monitor, comparing, work); });
      },
      py::arg("recordings"), py::arg("keywords"), py::arg("model"), py::arg("progress"));
}

}  // namespace suspension_health_monitor
