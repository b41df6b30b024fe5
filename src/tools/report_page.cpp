#include "report_page.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "recorded_drives.h"
#include "results.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {

NLOHMANN_JSON_SERIALIZE_ENUM(ForceVariable, {{ForceVariable::kTravel, "travel"},
                                             {ForceVariable::kTravelRate, "travel_rate"},
                                             {ForceVariable::kTime, "time"}})

namespace {

/// A model's numbers by name.
json valuesOf(const StrutModel& model, const std::vector<double>& stddevs) {
  json values;
  auto stddev = stddevs.begin();
  for (const ModelNumber& number : numbersOf(model)) {
    values[number.name] = {{"value", number.value}};
    if (stddev != stddevs.end()) values[number.name]["stddev"] = *stddev++;
  }
  return values;
}

/// The numbers of the model that was found, each before and after with its standard deviation.
json parametersJson(const ReportContent& content) {
  json values{{"before", valuesOf(content.before.model, content.before.stddev)}};
  if (const auto& fit = content.found.final_fit) values["after"] = valuesOf(fit->model, fit->stddev);
  json rows = jsonOf(numbersOf(content.found.model()));
  for (json& row : rows)
    for (const auto& [when, numbers] : values.items())
      if (const auto its = numbers.find(row["name"].get<std::string>()); its != numbers.end()) row[when] = *its;
  return rows;
}

constexpr int kLawPoints = 240;

/// The law over the range that was seen.  @pre force.lawAt() may be called.
json curveOf(const PartialResidual& force) {
  json at = json::array(), law = json::array();
  if (force.curve.size() > 1)
    for (int i = 0; i <= kLawPoints; ++i) {
      const double first = force.curve.front().at, last = force.curve.back().at;
      at.push_back(first + (last - first) * i / kLawPoints);
      law.push_back(force.lawAt(at.back()));
    }
  return {{"at", at}, {"law", law}};
}

json forceJson(const PartialResidual& force) {
  json result{{"effect", force.effect.effect.name}, {"law", force.effect.effect.law}, {"variables", force.variables}};
  if (force.variables.size() == 2)
    result.update({{"edges", json::array({force.grid.first_edges, force.grid.second_edges})},
                   {"cells", jsonOf(force.grid.cells)}});
  else if (force.hasMemory())
    result["branches"] = json::array({{{"name", "compressing"}, {"bins", jsonOf(force.curve)}},
                                      {{"name", "extending"}, {"bins", jsonOf(force.back)}}});
  else
    result.update(
        {{"branches", json::array({{{"name", ""}, {"bins", jsonOf(force.curve)}}})}, {"curve", curveOf(force)}});
  return result;
}

/// The force of every effect that was found, as it was seen and by its law.
json forcesJson(const ReportContent& content) {
  json forces = json::array();
  if (content.after == nullptr) return forces;
  const std::vector<std::string>& added = content.found.selected;
  for (const PartialResidual& force : content.after->forces)
    if (std::find(added.begin(), added.end(), force.effect.effect.name) != added.end())
      forces.push_back(forceJson(force));
  return forces;
}

/// What the page tells of every candidate, by name.
json effectsJson(const EffectLibrary& library) {
  json effects;
  for (const EffectLibrary::Description& effect : library.describe()) effects[effect.name] = jsonOf(effect);
  return effects;
}

/// The curves as --json has them, with the forces that a model has at their nodes.
json curvesJson(const json& strut, const StrutModel& model) {
  const std::array<Memory, kMostEffects> rest{};
  json damper = strut.at("damper_curve"), spring = strut.at("spring_curve");
  damper["law"] = spring["law"] = json::array();
  for (const double v : damper["velocity"]) damper["law"].push_back(model.force(0.0, v, 0.0, rest.data()));
  for (const double d : spring["travel"]) spring["law"].push_back(model.force(d, 0.0, 0.0, rest.data()));
  return {{"damper", damper}, {"spring", spring}};
}

json findingsOf(const ReportContent& content) {
  double duration = 0.0;
  const double period = *content.options.sample_period;
  for (const ComparedSegment& segment : content.before.segments)
    duration += static_cast<double>(segment.size()) * period;
  json findings{{"search", toJson(content.found)},
                {"source", sourceOf(content.source.drive_names, duration, period)},
                {"effects", effectsJson(content.options.candidates)},
                {"parameters", parametersJson(content)},
                {"drives", drivesJson(content)},
                {"before", shortened(toJson(content.before))},
                {"forces", shortened(forcesJson(content))},
                {"bags", content.source.drive_names},
                {"model_file", toYaml(content.found.model())},
                {"data", shortened(content.source.data)},
                {"origin", content.source.origin}};
  findings["origin"]["from"] = toSeconds(content.found.from);
  findings["origin"]["to"] = toSeconds(content.found.to);
  if (content.after != nullptr) findings["after"] = shortened(toJson(*content.after));
  return findings;
}

}  // namespace

ReportPage::ReportPage(const std::string& folder, const AskedVehicle& vehicle) : vehicle_(vehicle) {
  if (vehicle.only) {
    struts_.try_emplace(*vehicle.only, folder);
    return;
  }
  page_.emplace(folder);
  for (std::size_t i = 0; i < vehicle.names.size(); ++i)
    struts_.try_emplace(i, (std::filesystem::path(folder) / vehicle.names[i]).string());
}

void ReportPage::writeStrut(std::size_t place, const VehicleDiagnosis& all, const DiagnoseOptions& options, json& whole,
                            const PageSource& source) {
  const Diagnosis& found = all.struts[place];
  const std::vector<Drive>& drives = all.drives[place];
  CompareOptions comparing;
  comparing.sample_period = options.sample_period;
  comparing.model = found.base.model;
  Comparison before = compare(drives, comparing);
  if (!before) {  // nothing fits without what was found: clocks that differ
    comparing.fit = false;
    before = compare(drives, comparing);
  }
  requireEnough(before.shortcoming, before.reason);
  std::optional<Comparison> after;
  if (found.final_fit) {
    comparing.model = found.final_fit->model;
    comparing.fit = false;
    after = compare(drives, comparing);
  }
  json findings = findingsOf({found, options, source, before, after && *after ? &*after : nullptr});
  const json& its = vehicle_.resultsOf(place, whole);
  findings["change"] = its.value("change", "");
  findings["travel"] = shortened(its.at("travel"));
  findings["curves"] = shortened(curvesJson(its, found.model()));
  if (!vehicle_.isStrutAlone())
    findings["vehicle"] = {{"strut", vehicle_.names[place]},
                           {"file", vehicle_.file},
                           {"anti_roll_bars", whole["anti_roll_bars"]},
                           {"has_page", page_.has_value()}};
  struts_.at(place).write(searchTemplate(), findings);
}

void ReportPage::write(const VehicleDiagnosis& found, const DiagnoseOptions& options, json whole,
                       const PageSource& source) {
  if (vehicle_.only) return writeStrut(*vehicle_.only, found, options, whole, source);
  double samples = 0.0;
  for (const Drive& drive : found.drives.front()) samples += static_cast<double>(drive.samples.size());
  const double period = *options.sample_period;
  json places = json::array();
  for (std::size_t i = 0; i < vehicle_.names.size(); ++i) {
    if (found.struts[i]) writeStrut(i, found, options, whole, source);
    places.push_back({{"name", vehicle_.names[i]}});
    if (const auto& position = vehicle_.layout.struts[i].position) places.back()["position"] = *position;
  }
  whole.update({{"source", sourceOf(source.drive_names, samples * period, period)},
                {"places", places},
                {"data", source.data},
                {"effects", effectsJson(options.candidates)},
                {"origin", source.origin}});
  page_->write(vehicleTemplate(), shortened(std::move(whole)));
}

}  // namespace suspension_health_monitor
