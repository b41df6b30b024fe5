#include "bindings.h"
#include "options.h"
#include "readings.h"
#include "results.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

void bindRanking(py::module& module) {
  py::class_<RankedModel>(module, "RankedModel", "The model with effects added, judged by what no fit has seen.")
      .def_readonly("effects", &RankedModel::effects, "names of all that is in it")
      .def_readonly("model", &RankedModel::model)
      .def_readonly("fitted", &RankedModel::fitted, "False: by the linear response only")
      .def_property_readonly(
          "failure", [](const RankedModel& self) { return reasonOf(self.failure); },
          "why there is no such model; empty if there is")
      .def_readonly("held_out_rmse", &RankedModel::held_out_rmse, "[m/s^2]")
      .def_readonly("error_removed_percent", &RankedModel::error_removed_percent, "of the mean square before")
      .def_readonly("significance", &RankedModel::significance, "t of the improvement")
      .def_readonly("significant", &RankedModel::significant);
  py::class_<FittedModel>(module, "FittedModel", "A model with its uncertainty.")
      .def_readonly("model", &FittedModel::model)
      .def_readonly("stddev", &FittedModel::stddev, "of its numbers, in their order")
      .def_readonly("all_samples", &FittedModel::all_samples, "False: fitted to two thirds of them");
}

}  // namespace

void bindDiagnosis(py::module& module) {
  bindRanking(module);
  py::class_<SearchedStrut>(module, "Diagnosis", "What a search for missing effects found.")
      .def_property_readonly(
          "verdict", [](const SearchedStrut& self) { return nameOf(self.verdict); },
          "effect_found, suspect, nothing_missing or unexplained")
      .def_readonly("summary", &SearchedStrut::summary, "the verdict in a sentence")
      .def_readonly("remainder", &SearchedStrut::remainder, "what a suspect leaves, in a sentence")
      .def_readonly("selected", &SearchedStrut::selected, "names of what is to be added to the model")
      .def_readonly("indistinguishable", &SearchedStrut::indistinguishable,
                    "groups that these drives cannot tell apart")
      .def_readonly("suggested_drive", &SearchedStrut::suggested_drive, "what to record next")
      .def_readonly("base", &SearchedStrut::base, "the model that the search started with, fitted")
      .def_readonly("base_fit_percent", &SearchedStrut::base_fit_percent)
      .def_readonly("noise_floor", &SearchedStrut::noise_floor, "[m/s^2]")
      .def_readonly("structured_share", &SearchedStrut::structured_share, "of the base's error that is not noise")
      .def_readonly("surface_share", &SearchedStrut::surface_share, "that a force over travel and rate would take")
      .def_readonly("explained_share", &SearchedStrut::explained_share, "of the structure, by the effects named")
      .def_readonly("ranking", &SearchedStrut::ranking, "single effects, best first")
      .def_readonly("extended", &SearchedStrut::extended, "the model with what was found, as judged, or None")
      .def_readonly("extended_fit_percent", &SearchedStrut::extended_fit_percent)
      .def_readonly("final_fit", &SearchedStrut::final_fit, "the same fitted to all samples, or None")
      .def_readonly("change", &SearchedStrut::change, "against nominal values, in a sentence; empty: none are given")
      .def_readonly("not_tried", &SearchedStrut::not_tried, "(name, why) of candidates that these drives cannot tell")
      .def_property_readonly("model", &SearchedStrut::model, "to go on with: final_fit's, or the base's");
  module.def(
      "diagnose",
      [](const Recordings& recordings, const Keywords& keywords, const std::optional<StrutModel>& model,
         const EffectLibrary& candidates, int threads, const py::object& progress) {
        const ArrayOptions options = ArrayOptions::from(keywords.values);
        DiagnoseOptions searching;
        searching.model = model;
        searching.candidates = candidates;
        searching.threads = threads;
        const auto search = [&](const std::vector<Drive>& drives, const DiagnoseOptions& its) {
          SearchedStrut found{diagnose(drives, its), ""};
          if (found) found.change = describeChange(drives, its, nominalOf(options.monitor), options.monitor);
          return found;
        };
        LongWork work(progress);
        return work.run([&] { return judgeArrays(search, recordings, options.monitor, searching, work); });
      },
      py::arg("recordings"), py::arg("keywords"), py::arg("model"), py::arg("candidates"), py::arg("threads"),
      py::arg("progress"));
}

}  // namespace suspension_health_monitor
