#include <pybind11/eigen.h>

#include "bindings.h"
#include "results.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {

SHM_FIELDS(Identification, sample_period, horizon_samples, estimate, now, ls, la, samples, rows, gaps, clock_jumps,
           rejected, warnings, mean_period, alignment, bridged, tyre, sprung_mass, change, course)
SHM_FIELDS(HealthSummary, events, early_warnings, end, seconds, counts, estimate, ls, la, reference, baseline, rejected,
           course)
SHM_FIELDS(SearchedStrut, verdict, summary, remainder, selected, indistinguishable, suggested_drive, base,
           base_fit_percent, noise_floor, structured_share, surface_share, explained_share, ranking, extended,
           extended_fit_percent, final_fit, change, not_tried)

namespace {

/// Bins: of each field an array, one entry per bin.
template <class Bin>
void bindBins(py::module& module, const char* class_name, const char* text) {
  ResultClass<std::vector<Bin>> bins(module, class_name, text);
  bins.def("__len__", [](const std::vector<Bin>& self) { return self.size(); });
  Fields<Bin>::forEach([&](const std::string_view name, auto field) {
    bins.add(name == "from" ? "from_" : name.data(),  // from is a keyword of Python
             [field](const std::vector<Bin>& self) { return arrayOf(self, field); });
  });
}

void bindViews(py::module& module) {
  bindBins<ResidualBin>(module, "ResidualBins", "Mean missing force over ranges of travel [m] or rate [m/s].");
  bindBins<TimeBin>(module, "TimeBins",
                    "Residual over stretches of time [s], with what b1 and b0 seem to be off by in each.");
  ResultClass<ForceSurface>(module, "ForceSurface",
                            "Mean missing force over travel (rows) and travel rate (columns) [m/s^2].");
  ResultClass<ResidualSpectrum>(module, "ResidualSpectrum", "Power spectral densities, one-sided.");
  ResultClass<ResidualCorrelation>(module, "ResidualCorrelation", "A correlation coefficient against lag.");
  ResultClass<DirectionLoop>(module, "DirectionLoop", "Missing force against travel, apart for the two directions.");
  ResultClass<ResidualViews>(module, "ResidualViews", "The residual seen from all sides.");
}

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

/// @return arrays by their names in JSON.
py::dict columnsOf(const char* variable, const ForceCurve& curve) {
  py::dict columns;
  for (const auto& [name, numbers] :
       {std::pair(variable, &curve.at), {"force", &curve.force}, {"stddev", &curve.stddev}})
    columns[name] = arrayOf(*numbers, [](double number) { return number; });
  return columns;
}

/// @return by effect what leaving it out does to b1 and b0, by the names of JSON.
py::list costs(const SearchedStrut& found) {
  py::list costs;
  for (const EffectCost& cost : costsOf(found)) {
    py::dict row;
    row["effect"] = cost.effect;
    row["sentence"] = describe(cost);
    row["harmless"] = cost.isHarmless();
    for (const auto& [name, change] : {std::pair("damping", cost.damping), {"stiffness", cost.stiffness}})
      if (change && cost.fits_without)
        row[name] = py::dict(py::arg("change") = change->value, py::arg("stddev") = change->stddev);
    costs.append(row);
  }
  return costs;
}

void bindDiagnosis(py::module& module) {
  ResultClass<TimeHistogram::Direction>(module, "TravelDirection", "Compression or rebound.");
  ResultClass<TimeHistogram>(module, "TimeHistogram", "How long travel or its rate had which value.");
  ResultClass<StopUse>(module, "StopUse", "How a stop is used.");
  ResultClass<TravelStatistics>(module, "Travel", "How far and how fast the strut moved.");
  ResultClass<RankedModel>(module, "RankedModel", "The model with effects added, judged by what no fit has seen.")
      .add("failure", [](const RankedModel& self) { return reasonOf(self.failure); });
  ResultClass<FittedModel>(module, "FittedModel", "A model with its uncertainty.");
  ResultClass<SearchedStrut>(module, "Diagnosis", "What a search for missing effects found.")
      .add("model", &SearchedStrut::model)
      .add("damper_curve",
           [](const SearchedStrut& self) { return columnsOf("velocity", self.curves.damper.absolute()); })
      .add("spring_curve", [](const SearchedStrut& self) { return columnsOf("travel", self.curves.spring.absolute()); })
      .add("travel", &SearchedStrut::travel)
      .add("costs", &costs);
}

}  // namespace

void bindResults(py::module& module) {
  ResultClass<Identification>(module, "Identification", "A strut identified from recorded drives.")
      .add("iv", &Identification::estimate);  // until the next version
  ResultClass<HealthMoment>(module, "HealthMoment", "What a monitor said at one time.");
  ResultClass<HealthSummary>(module, "Health", "What the monitor would have said over recorded drives, and when.");
  bindViews(module);
  bindComparison(module);
  bindDiagnosis(module);
}

}  // namespace suspension_health_monitor
