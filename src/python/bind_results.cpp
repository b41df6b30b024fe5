#include "bindings.h"
#include "results.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

BOOST_HANA_ADAPT_STRUCT(shm::Identification, sample_period, horizon_samples, estimate, now, ls, la, samples, rows, gaps,
                        clock_jumps, rejected, warnings, mean_period, alignment, bridged, tyre, sprung_mass, change,
                        course);
BOOST_HANA_ADAPT_STRUCT(shm::HealthSummary, events, early_warnings, end, seconds, counts, estimate, ls, la, reference,
                        baseline, rejected, course);
BOOST_HANA_ADAPT_STRUCT(shm::SearchedStrut, verdict, summary, remainder, selected, indistinguishable, suggested_drive,
                        base, base_fit_percent, noise_floor, structured_share, surface_share, explained_share, ranking,
                        extended, extended_fit_percent, final_fit, change, not_tried);

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

std::vector<double> timesOf(const ComparedSegment& segment) {
  std::vector<double> times(segment.size());
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = segment.time(k);
  return times;
}

void bindComparison(py::module& module) {
  ResultClass<PredictionError>(module, "PredictionError", "How far a prediction is from the measurement.");
  ResultClass<FailureRegion>(module, "FailureRegion", "A part of the drive where the model fails.");
  ResultClass<ComparedSegment>(module, "ComparedSegment",
                               "A free run beside the measurement between two gaps; one entry per sample.")
      .addArray("time", &timesOf);
  ResultClass<Comparison>(module, "Comparison", "A model beside the measurement: how good it is, and where it fails.")
      .add("fitted", [](const Comparison& self) { return !self.stddev.empty(); });
}

void bindDiagnosis(py::module& module) {
  ResultClass<RankedModel>(module, "RankedModel", "The model with effects added, judged by what no fit has seen.")
      .add("failure", [](const RankedModel& self) { return reasonOf(self.failure); });
  ResultClass<FittedModel>(module, "FittedModel", "A model with its uncertainty.");
  ResultClass<SearchedStrut>(module, "Diagnosis", "What a search for missing effects found.")
      .add("model", &SearchedStrut::model);
}

}  // namespace

void bindResults(py::module& module) {
  ResultClass<Identification>(module, "Identification", "A strut identified from recorded drives.")
      .add("iv", &Identification::estimate);  // until the next version
  ResultClass<HealthMoment>(module, "HealthMoment", "What a monitor said at one time.")
      .add("time", &HealthMoment::stamp);
  ResultClass<HealthSummary>(module, "Health", "What the monitor would have said over recorded drives, and when.");
  bindComparison(module);
  bindDiagnosis(module);
}

}  // namespace suspension_health_monitor
