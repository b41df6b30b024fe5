#include <cstdio>

#include "../ros/model_file.h"
#include "checked_imus.h"
#include "command.h"
#include "long_work.h"
#include "recorded_drives.h"
#include "report_page.h"
#include "results.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kShownCandidates = 8;

json standardDeviations(const FittedModel& fit) {
  json result = json::object();
  auto stddev = fit.stddev.begin();
  for (const ModelNumber& number : numbersOf(fit.model)) result[number.name] = *stddev++;
  return result;
}

void printFit(const FittedModel& fit) {
  auto stddev = fit.stddev.begin();
  for (const ModelNumber& number : numbersOf(fit.model)) {
    if (number.kind == ModelNumber::Kind::kStrut)
      std::printf("  %-15s", number.symbol == "b1" ? "damping/mass" : "stiffness/mass");
    else if (number.kind == ModelNumber::Kind::kShape)
      std::printf("    %s =", number.symbol.c_str());
    else
      std::printf("  %s  c =", number.name.c_str());
    std::printf(" %.5g +- %.2g %s\n", number.value, *stddev++, number.unit.c_str());
  }
  if (!fit.all_samples)
    std::printf("  The fit to all samples failed: these are the numbers of the fit to two thirds of them.\n");
}

/// The verdict in a sentence, the ranked table, before and after.
void printSearch(const Diagnosis& found) {
  std::printf("%s\n", found.summary.c_str());
  for (const EffectCost& cost : costsOf(found))
    std::printf("%s\n", join({describe(cost), cost.isHarmless() ? "" : cost.advice}, " ").c_str());
  if (!found.remainder.empty()) std::printf("%s\n", found.remainder.c_str());
  for (const std::vector<std::string>& group : found.indistinguishable)
    std::printf("These drives cannot tell apart: %s.\n", join(group, ", ").c_str());
  if (!found.suggested_drive.empty()) std::printf("%s\n", found.suggested_drive.c_str());
  std::printf("\nmodel as it is: held-out rmse %.4g m/s^2, fit %.1f %%, noise floor about %.4g m/s^2\n",
              found.base.held_out_rmse, found.base_fit_percent, found.noise_floor);
  std::printf("\nadded alone                    held-out rmse   error removed   significant\n");
  bool all_fitted = true;
  for (std::size_t i = 0; i < std::min(kShownCandidates, found.ranking.size()); ++i) {
    const RankedModel& ranked = found.ranking[i];
    if (ranked.failure != FitFailure::kNone) {
      std::printf("%-30s             -                -   no: %s\n", join(ranked.effects, " + ").c_str(),
                  reasonOf(ranked.failure));
      continue;
    }
    all_fitted = all_fitted && ranked.fitted;
    std::printf("%-30s %c%12.4g %14.1f %%   %s\n", join(ranked.effects, " + ").c_str(), ranked.fitted ? ' ' : '~',
                ranked.held_out_rmse, ranked.error_removed_percent, ranked.significant ? "yes" : "no");
  }
  if (!all_fitted) std::printf("~ by the linear response only: far behind, not fitted\n");
  if (!found.extended) return;
  std::printf("\nwith %s: held-out rmse %.4g m/s^2, fit %.1f %%\n", join(found.selected, " and ").c_str(),
              found.extended->held_out_rmse, found.extended_fit_percent);
  printFit(*found.final_fit);
}

json toJson(const EffectCost& cost) {
  json row{{"effect", cost.effect}, {"sentence", describe(cost)}, {"harmless", cost.isHarmless()}};
  for (const auto& [name, change] : {std::pair("damping", cost.damping), {"stiffness", cost.stiffness}})
    if (change && cost.fits_without) row[name] = {{"change", change->value}, {"stddev", change->stddev}};
  return row;
}

/// Tells people how far and how fast a strut moves, and how its stops are used; nothing of one that does not move.
void printTravel(const TravelStatistics& travel) {
  if (travel.travel.edges.empty()) return;
  std::printf("travel up to %.3g mm in compression and %.3g mm in rebound, up to %.3g and %.3g m/s\n",
              1e3 * travel.travel.compression.largest, 1e3 * travel.travel.rebound.largest,
              travel.travel_rate.compression.largest, travel.travel_rate.rebound.largest);
  for (const StopUse& stop : travel.stops)
    std::printf("%s at %.3g mm: hit %d times, %s of the time in the last tenth before it or in it\n",
                stop.effect.c_str(), 1e3 * stop.gap, stop.hits, percent(stop.near).c_str());
}

/// Tells people which candidates were not tried.
/// @return the same for programs.
json tellNotTried(const Diagnosis& strut) {
  json reasons = json::object();
  for (const auto& [name, reason] : strut.not_tried) {
    std::printf("not tried: %s, %s\n", name.c_str(), reason.c_str());
    reasons[name] = reason;
  }
  return reasons;
}

/// Tells people what was found of the struts that are asked for.
/// @return the same for programs.
json tell(const VehicleDiagnosis& found, const AskedDrives& asked, const std::vector<std::string>& changes) {
  const AskedVehicle& vehicle = asked.options.vehicle;
  json whole = wholeJson(vehicle, found.coupling, asked.gaps);
  if (!vehicle.isStrutAlone()) {
    std::printf("%s\n", found.summary.c_str());
    printCoupling(found.coupling, vehicle.names);
    whole.update({{"verdict", nameOf(found.verdict)}, {"summary", found.summary}, {"selected", json::object()}});
  }
  for (const std::size_t i : vehicle.asked) {
    const Diagnosis& strut = found.struts[i];
    json& its = vehicle.resultsOf(i, whole);
    std::printf("\n%s", vehicle.prefix(i, ": ").c_str());
    if (strut) {
      printSearch(strut);
      its.update(toJson(strut));
      its["verdict"] = nameOf(found.verdictOn(i));
      const StrutCurves curves =
          strutCurves(found.drives[i], strut.model(), asked.options.period(), found.coupling.modelErrorOf(i));
      printCurves(curves, asked.options.settings.struts[i].monitor.sprung_mass);
      addCurves(curves, its);
      const TravelStatistics travel = travelStatistics(found.drives[i], strut.model(), asked.options.period());
      printTravel(travel);
      its["travel"] = jsonOf(travel);
    } else {
      std::printf("the drives %s\n", strut.reason.c_str());
      its["reason"] = strut.reason;
    }
    printChange(changes[i]);
    if (!changes[i].empty()) its["change"] = changes[i];
    its["selected"] = found.selected(i);
    if (vehicle.isStrutAlone())
      its["not_tried"] = tellNotTried(strut);
    else
      whole["selected"][vehicle.names[i]] = its["selected"];
  }
  return whole;
}

/// The models of all struts that have one, or that of --strut alone, as readModels() takes them.
std::string modelText(const VehicleDiagnosis& found, const AskedVehicle& vehicle) {
  if (vehicle.only) return toYaml(found.struts[*vehicle.only].model());
  ModelsByStrut models;
  for (std::size_t i = 0; i < found.struts.size(); ++i)
    if (found.struts[i]) models.emplace(vehicle.names[i], found.struts[i].model());
  return toYaml(models);
}

void search(const po::variables_map& values) {
  DiagnoseOptions searching;
  searching.threads = threadsOf(values);  // refuses a wrong number before any file is read
  AskedDrives asked(values);
  const AskedVehicle& vehicle = asked.options.vehicle;
  std::optional<TextFile> file = outputFile(values, "json"), model = outputFile(values, "output");
  std::optional<ReportPage> page;
  if (values.count(kReport) != 0) page.emplace(values[kReport].as<std::string>(), vehicle);
  asked.read();
  Progress progress("searching", 1.0);
  searching.progress = [&](double share) { progress.update(share); };
  const VehicleDiagnosis found = diagnoseBags(asked, searching);
  const std::vector<std::string> changes = changesOf(asked);
  progress.clear();
  printBags(asked.options, asked.recorded.bags, asked.gaps);
  const json whole = tell(found, asked, changes);
  if (file) file->commit(whole.dump(2) + '\n');
  if (model) model->commit(modelText(found, vehicle));
  const ImuBags& bags = asked.options.bags;
  if (page)
    page->write(found, searching, whole,
                {fileNames(bags.paths), originOf(values, namesOf(bags.topics)), dataJson(asked.options)});
  printWritten(values, {"json", "output", kReport});
}

}  // namespace

void addNumbers(const StrutModel& model, json& into) {
  into["parameters"] = jsonOf(model);
  into["coefficients"] = into["shapes"] = json::object();
  for (const ModelNumber& number : numbersOf(model)) {
    if (number.kind == ModelNumber::Kind::kCoefficient) into["coefficients"][number.name] = number.value;
    if (number.kind == ModelNumber::Kind::kShape) into["shapes"][number.name] = number.value;
  }
}

json toJson(const Diagnosis& found) {
  json ranking = json::array();
  for (const RankedModel& ranked : found.ranking) {
    json row = jsonOf(ranked);
    row.erase("model");  // its numbers follow by name
    if (ranked.failure != FitFailure::kNone) row["failure"] = reasonOf(ranked.failure);
    addNumbers(ranked.model, row);
    ranking.push_back(row);
  }
  json whole = jsonOf(found);
  whole["ranking"] = ranking;
  whole["base"] = {{"held_out_rmse", found.base.held_out_rmse},
                   {"fit_percent", found.base_fit_percent},
                   {"parameters", jsonOf(found.base.model)}};
  if (!found.remainder.empty()) whole["remainder"] = found.remainder;
  if (found.extended) {
    whole["explained_share"] = found.explained_share;
    json extended{{"held_out_rmse", found.extended->held_out_rmse},
                  {"fit_percent", found.extended_fit_percent},
                  {"fitted_to_all_samples", found.final_fit->all_samples},
                  {"stddevs", standardDeviations(*found.final_fit)}};
    addNumbers(found.final_fit->model, extended);
    whole["extended"] = extended;
    for (const EffectCost& cost : costsOf(found)) whole["costs"].push_back(toJson(cost));
  }
  return whole;
}

void diagnose(const Arguments& arguments) {
  po::options_description description = bagOptions();
  addModelOptions(description);
  auto add = description.add_options();
  add("output,o", po::value<std::string>(), "write the model that was found as YAML; of a vehicle those of its struts");
  add(kReport, po::value<std::string>(),
      "write DIR/report.html: the search as a page with figures; of a vehicle also DIR/NAME/report.html of every "
      "strut");
  runOnBags(arguments, "diagnose BAG... [OPTION]...", description, {"json", "output", kReport}, &search);
}

}  // namespace suspension_health_monitor
