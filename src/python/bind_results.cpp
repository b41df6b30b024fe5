#include "bindings.h"
#include "results.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

void bindIdentification(py::module& module) {
  ResultClass<Identification>(module, "Identification", "A strut identified from recorded drives.")
      .add("sample_period", "T [s]", &Identification::sample_period)
      .add("horizon_samples", "L of the integral filter", &Identification::horizon_samples)
      .add("estimate", "over the whole drive: what to trust", &Identification::estimate)
      .add("now", "the same at the end of the drive, as the live monitor has it", &Identification::now)
      .add("ls", "at the end of the drive, by least squares", &Identification::ls)
      .add("la", "the same by the least sum of absolute values", &Identification::la)
      .add("iv", "estimate, by its former name, until the next version", &Identification::estimate)
      .add("samples", "taken in", &Identification::samples)
      .add("rows", "regression rows that they gave", &Identification::rows)
      .add("gaps", "", &Identification::gaps)
      .add("clock_jumps", "", &Identification::clock_jumps)
      .add("rejected", "readings that were kept out, by reason", &Identification::rejected)
      .add("warnings", "of sensors and stamps, in words", &Identification::warnings)
      .add("mean_period", "of uninterrupted samples [s]", &Identification::mean_period)
      .add("alignment", "how readings became samples, in words", &Identification::alignment)
      .add("bridged", "samples made of readings around a gap", &Identification::bridged)
      .add("tyre", "of a recording with a road sensor, else None", &Identification::tyre)
      .add("sprung_mass", "[kg], as it was given, or None", &Identification::sprung_mass)
      .add("change", "against nominal values, in a sentence; empty: none are given", &Identification::change)
      .add("course", "estimates over time", &Identification::course);
}

void bindHealth(py::module& module) {
  ResultClass<HealthMoment>(module, "HealthMoment", "What a monitor said at one time.")
      .add("time", "its stamp [s]", &HealthMoment::stamp)
      .add("elapsed", "time that the recordings have covered until then [s]", &HealthMoment::elapsed)
      .add("level", "OK, WARN, ERROR or STALE", &HealthMoment::level)
      .add("message", "why", &HealthMoment::message);
  ResultClass<HealthSummary>(module, "Health", "What the monitor would have said over recorded drives, and when.")
      .add("events", "changes of level, in the order of time", &HealthSummary::events)
      .add("early_warnings", "when one began", &HealthSummary::early_warnings)
      .add("end", "what is said at the end", &HealthSummary::end)
      .add("seconds", "how long each level held [s]", &HealthSummary::seconds)
      .add("counts", "changes to each level", &HealthSummary::counts)
      .add("estimate", "at the end, what the strut is judged by", &HealthSummary::estimate)
      .add("ls", "estimates at the end", &HealthSummary::ls)
      .add("la", "estimates at the end", &HealthSummary::la)
      .add("reference", "what the strut was judged by at the end, in words", &HealthSummary::reference)
      .add("baseline", "the same; of no use if nothing was given or learned", &HealthSummary::baseline)
      .add("rejected", "readings that were kept out, by reason", &HealthSummary::rejected)
      .add("course", "estimates and level over time", &HealthSummary::course);
}

std::vector<double> timesOf(const ComparedSegment& segment) {
  std::vector<double> times(segment.size());
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = segment.time(k);
  return times;
}

void bindComparison(py::module& module) {
  ResultClass<PredictionError>(module, "PredictionError", "How far a prediction is from the measurement.")
      .add("rmse", "[m/s^2]", &PredictionError::rmse)
      .add("fit_percent", "100 is perfect, 0 no better than a constant", &PredictionError::fit_percent);
  ResultClass<FailureRegion>(module, "FailureRegion", "A part of the drive where the model fails.")
      .add("region", "in a few words", &FailureRegion::region)
      .add("sentence", "where, how often, how much, compared with elsewhere", &FailureRegion::sentence)
      .add("rmse", "[m/s^2]", &FailureRegion::rmse)
      .add("rmse_elsewhere", "[m/s^2]; 0 if the region is everything", &FailureRegion::rmse_elsewhere)
      .add("mean", "missing force in the region [m/s^2]", &FailureRegion::mean)
      .add("share", "of the samples", &FailureRegion::share);
  ResultClass<ComparedSegment>(module, "ComparedSegment",
                               "A free run beside the measurement between two gaps; one entry per sample.")
      .add("drive", "which of the drives, from 0", &ComparedSegment::record)
      .add("period", "T [s]", &ComparedSegment::period)
      .addArray("time", "since the start of the drive [s]", &timesOf)
      .addArray("measured", "z'' less the mean w'' [m/s^2]", &ComparedSegment::measured)
      .addArray("predicted", "by the free run [m/s^2]", &ComparedSegment::predicted)
      .addArray("wheel", "w'' less its mean [m/s^2]", &ComparedSegment::wheel)
      .addArray("travel", "of the free run, compression positive [m]", &ComparedSegment::travel)
      .addArray("travel_rate", "[m/s]", &ComparedSegment::travel_rate)
      .addArray("added_force", "the effects' part of the model [m/s^2]", &ComparedSegment::added_force)
      .addArray("missing_force", "what the model lacks, per unit mass [m/s^2]", &ComparedSegment::missing_force);
  ResultClass<Comparison>(module, "Comparison", "A model beside the measurement: how good it is, and where it fails.")
      .add("model", "as it was compared", &Comparison::model)
      .add("stddev", "of its numbers, in their order; empty if they were given", &Comparison::stddev)
      .add("fitted", "", [](const Comparison& self) { return !self.stddev.empty(); })
      .add("free_run", "z'' predicted from w'' alone", &Comparison::free_run)
      .add("held_out_rmse", "on blocks that no fit has seen [m/s^2], or None", &Comparison::held_out_rmse)
      .add("one_step", "rows of the regression with the same numbers, or None", &Comparison::one_step)
      .add("horizon_samples", "L of these rows", &Comparison::horizon_samples)
      .add("noise_floor", "what sensor noise alone leaves [m/s^2]", &Comparison::noise_floor)
      .add("structured_share", "share of the error that is not noise", &Comparison::structured_share)
      .add("where", "worst first", &Comparison::where)
      .add("views", "", &Comparison::views)
      .add("segments", "for plots over time", &Comparison::segments);
}

void bindDiagnosis(py::module& module) {
  ResultClass<RankedModel>(module, "RankedModel", "The model with effects added, judged by what no fit has seen.")
      .add("effects", "names of all that is in it", &RankedModel::effects)
      .add("model", "", &RankedModel::model)
      .add("fitted", "False: by the linear response only", &RankedModel::fitted)
      .add("failure", "why there is no such model; empty if there is",
           [](const RankedModel& self) { return reasonOf(self.failure); })
      .add("held_out_rmse", "[m/s^2]", &RankedModel::held_out_rmse)
      .add("error_removed_percent", "of the mean square before", &RankedModel::error_removed_percent)
      .add("significance", "t of the improvement", &RankedModel::significance)
      .add("significant", "", &RankedModel::significant);
  ResultClass<FittedModel>(module, "FittedModel", "A model with its uncertainty.")
      .add("model", "", &FittedModel::model)
      .add("stddev", "of its numbers, in their order", &FittedModel::stddev)
      .add("all_samples", "False: fitted to two thirds of them", &FittedModel::all_samples);
  ResultClass<SearchedStrut>(module, "Diagnosis", "What a search for missing effects found.")
      .add("verdict", "effect_found, suspect, nothing_missing or unexplained", &SearchedStrut::verdict)
      .add("summary", "the verdict in a sentence", &SearchedStrut::summary)
      .add("remainder", "what a suspect leaves, in a sentence", &SearchedStrut::remainder)
      .add("selected", "names of what is to be added to the model", &SearchedStrut::selected)
      .add("indistinguishable", "groups that these drives cannot tell apart", &SearchedStrut::indistinguishable)
      .add("suggested_drive", "what to record next", &SearchedStrut::suggested_drive)
      .add("base", "the model that the search started with, fitted", &SearchedStrut::base)
      .add("base_fit_percent", "", &SearchedStrut::base_fit_percent)
      .add("noise_floor", "[m/s^2]", &SearchedStrut::noise_floor)
      .add("structured_share", "of the base's error that is not noise", &SearchedStrut::structured_share)
      .add("surface_share", "that a force over travel and rate would take", &SearchedStrut::surface_share)
      .add("explained_share", "of the structure, by the effects named", &SearchedStrut::explained_share)
      .add("ranking", "single effects, best first", &SearchedStrut::ranking)
      .add("extended", "the model with what was found, as judged, or None", &SearchedStrut::extended)
      .add("extended_fit_percent", "", &SearchedStrut::extended_fit_percent)
      .add("final_fit", "the same fitted to all samples, or None", &SearchedStrut::final_fit)
      .add("change", "against nominal values, in a sentence; empty: none are given", &SearchedStrut::change)
      .add("not_tried", "(name, why) of candidates that these drives cannot tell", &SearchedStrut::not_tried)
      .add("model", "to go on with: final_fit's, or the base's", &SearchedStrut::model);
}

}  // namespace

void bindResults(py::module& module) {
  bindIdentification(module);
  bindHealth(module);
  bindComparison(module);
  bindDiagnosis(module);
}

}  // namespace suspension_health_monitor
