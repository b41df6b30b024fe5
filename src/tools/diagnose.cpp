#include <cstdio>

#include "../ros/model_file.h"
#include "command.h"
#include "long_work.h"
#include "recorded_search.h"
#include "report_page.h"
#include "results.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;
using nlohmann::json;

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
json tell(const VehicleDiagnosis& found, const AskedVehicle& vehicle, const std::vector<std::string>& changes,
          const TopicGaps& gaps) {
  json whole = wholeJson(vehicle, found.coupling, gaps);
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
  searching.threads = threadsOf(values);
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
  printBags(asked.options, asked.bags, asked.gaps);
  const json whole = tell(found, vehicle, changes, asked.gaps);
  if (file) file->commit(whole.dump(2) + '\n');
  if (model) model->commit(modelText(found, vehicle));
  const ImuBags& bags = asked.options.bags;
  if (page) page->write(found, searching, whole, {fileNames(bags.paths), originOf(values, bags.allTopics())});
}

}  // namespace

void diagnose(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addModelOptions(description);
  auto add = description.add_options();
  add("output,o", po::value<std::string>(), "write the model that was found as YAML; of a vehicle those of its struts");
  add(kReport, po::value<std::string>(),
      "write DIR/report.html: the search as a page with figures; of a vehicle also DIR/NAME/report.html of every "
      "strut");
  const auto values = parse(arguments, "diagnose BAG... [OPTION]...", description, "bag");
  if (!values) return;
  const std::vector<std::string> outputs{"json", "output", kReport};
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kEffectsFile, kModel}, outputs);
  threadsOf(*values);  // refuses a wrong number before any file is read
  const Interruption interruption;
  search(*values);
  printWritten(*values, outputs);
}

}  // namespace suspension_health_monitor
