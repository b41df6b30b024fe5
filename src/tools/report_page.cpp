#include "report_page.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "recorded_search.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

json findingsOf(const ReportContent& content) {
  double duration = 0.0;
  for (const ComparedSegment& segment : content.before.segments)
    duration += static_cast<double>(segment.size()) * content.period;
  const std::string strut = content.vehicle ? content.vehicle->strut + " in " : "";
  json findings{{"search", toJson(content.found)},
                {"source", strut + sourceOf(content.source.drive_names, duration, content.period)},
                {"change", content.source.change},
                {"effects", effectsJson(content.library)},
                {"parameters", parametersJson(content)},
                {"drives", drivesJson(content)},
                {"before", shortened(toJson(content.before))},
                {"forces", shortened(forcesJson(content))},
                {"adding", addingJson(content)},
                {"origin", content.source.origin}};
  findings["origin"]["from"] = toSeconds(content.found.from);
  findings["origin"]["to"] = toSeconds(content.found.to);
  if (content.after != nullptr) findings["after"] = shortened(toJson(*content.after));
  if (const InVehicle* vehicle = content.vehicle)
    findings["vehicle"] = {{"strut", vehicle->strut}, {"bars", vehicle->bars}, {"has_page", vehicle->has_page}};
  return findings;
}

/// @param has_page  of its own, to be opened.
json strutJson(const VehicleLayout::Strut& strut, std::size_t place, const VehicleDiagnosis& found, bool has_page) {
  const Diagnosis& its = found.struts[place];
  json result{{"name", strut.name}, {"has_page", has_page}};
  if (strut.position) result["position"] = *strut.position;
  if (!its) {
    result["verdict"] = "cannot_tell";
    result["reason"] = its.reason;
    return result;
  }
  result["verdict"] = nameOf(found.verdictOn(place));
  result["selected"] = found.selected(place);
  result["indistinguishable"] = its.indistinguishable;
  result["damping_to_mass"] = its.model().damping_to_mass;
  result["stiffness_to_mass"] = its.model().stiffness_to_mass;
  result["error_before"] = its.base.held_out_rmse;
  if (its.extended) result["error_after"] = its.extended->held_out_rmse;
  result["noise_floor"] = its.noise_floor;
  return result;
}

json barsJson(const VehicleCoupling& coupling) {
  json bars = json::array();
  for (const AntiRollBarFound& bar : coupling.bars)
    bars.push_back({{"struts", {bar.first, bar.second}},
                    {"stiffness_to_mass", {bar.first_stiffness_to_mass, bar.second_stiffness_to_mass}}});
  return bars;
}

json forcesJson(const VehicleCoupling& coupling) {
  json forces = json::array();
  for (const KnownForceCoefficients& force : coupling.forces)
    forces.push_back({{"name", force.name}, {"coefficients", force.values}, {"stddevs", force.stddevs}});
  return forces;
}

/// The struts that bars tie one to.
std::vector<std::string> partnersOf(std::size_t place, const VehicleCoupling& coupling,
                                    const std::vector<std::string>& names) {
  std::vector<std::string> partners;
  for (const AntiRollBarFound& bar : coupling.bars) {
    if (bar.first == place) partners.push_back(names[bar.second]);
    if (bar.second == place) partners.push_back(names[bar.first]);
  }
  return partners;
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

void ReportPage::writeStrut(std::size_t place, const VehicleDiagnosis& all, const DiagnoseOptions& options,
                            const std::string& change, PageSource source) {
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
  source.change = change;
  const InVehicle in{vehicle_.names[place], vehicle_.file, partnersOf(place, all.coupling, vehicle_.names),
                     page_.has_value()};
  struts_.at(place).write(searchTemplate(),
                          findingsOf({found, options.candidates, *options.sample_period, source, before,
                                      after && *after ? &*after : nullptr, vehicle_.isStrutAlone() ? nullptr : &in}));
}

void ReportPage::write(const VehicleDiagnosis& found, const DiagnoseOptions& options,
                       const std::vector<std::string>& changes, const PageSource& source) {
  if (vehicle_.only) return writeStrut(*vehicle_.only, found, options, changes[*vehicle_.only], source);
  double samples = 0.0;
  for (const Drive& drive : found.drives.front()) samples += static_cast<double>(drive.samples.size());
  const double period = *options.sample_period;
  json struts = json::array();
  for (std::size_t i = 0; i < vehicle_.names.size(); ++i) {
    if (found.struts[i]) writeStrut(i, found, options, changes[i], source);
    struts.push_back(strutJson(vehicle_.layout.struts[i], i, found, static_cast<bool>(found.struts[i])));
    struts.back()["change"] = changes[i];
  }
  page_->write(vehicleTemplate(), shortened({{"source", sourceOf(source.drive_names, samples * period, period)},
                                             {"verdict", nameOf(found.verdict)},
                                             {"summary", found.summary},
                                             {"struts", struts},
                                             {"ratios", found.coupling.ratios},
                                             {"stddevs", found.coupling.stddevs},
                                             {"model_error", found.coupling.model_error},
                                             {"anti_roll_bars", barsJson(found.coupling)},
                                             {"known_forces", forcesJson(found.coupling)},
                                             {"origin", source.origin}}));
}

}  // namespace suspension_health_monitor
