#include <cstdio>

#include "../ros/model_file.h"
#include "bag_options.h"
#include "command.h"
#include "long_work.h"
#include "recorded_strut.h"
#include "report_page.h"
#include "results.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;
using nlohmann::json;

/// @throws TooLittleError  if there is nothing to be said of any strut that is asked for.
void requireOne(const VehicleDiagnosis& found, const AskedVehicle& vehicle) {
  requireCoupling(found.coupling);
  for (const std::size_t i : vehicle.asked)
    if (found.struts[i]) return;
  const std::size_t first = vehicle.asked.front();
  throw TooLittleError(vehicle.names[first] + ": the drives " + found.struts[first].reason);
}

/// Tells people what was found of the struts that are asked for.
/// @return the same for programs.
json tell(const VehicleDiagnosis& found, const AskedVehicle& vehicle, const std::vector<std::string>& changes) {
  std::printf("%s\n", found.summary.c_str());
  printCoupling(found.coupling, vehicle.names);
  json whole = toJson(found.coupling, vehicle.names);
  whole["verdict"] = nameOf(found.verdict);
  whole["summary"] = found.summary;
  whole["selected"] = json::object();
  for (const std::size_t i : vehicle.asked) {
    const Diagnosis& strut = found.struts[i];
    json& its = whole["struts"][vehicle.names[i]];
    std::printf("\n%s: ", vehicle.names[i].c_str());
    if (strut) {
      printSearch(strut);
      its = toJson(strut);
      its["verdict"] = nameOf(found.verdictOn(i));
    } else {
      std::printf("the drives %s\n", strut.reason.c_str());
      its["reason"] = strut.reason;
    }
    printChange(changes[i]);
    if (!changes[i].empty()) its["change"] = changes[i];
    whole["selected"][vehicle.names[i]] = its["selected"] = found.selected(i);
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

void diagnoseStrut(const po::variables_map& values) {
  const int threads = threadsOf(values);
  const ModelOptions models = readModelOptions(values);
  const BagOptions options = readBagOptions(values, true);
  std::optional<TextFile> file = outputFile(values, "json"), model = outputFile(values, "output");
  std::optional<ReportPage> page;
  if (values.count(kReport) != 0) page.emplace(values[kReport].as<std::string>());

  TopicGaps gaps(options.pipeline.shell.input_timeout);
  Progress progress("fitting", 1.0);
  const RecordedDiagnosis recorded =
      diagnoseBags(options, models, threads, gaps, [&](double share) { progress.update(share); });
  const Diagnosis& found = recorded.found;
  progress.clear();
  gaps.print();
  printSearch(found);
  printChange(recorded.change);
  json whole = toJson(found);
  whole["silent"] = gaps.toJson();
  if (!recorded.change.empty()) whole["change"] = recorded.change;
  whole["not_tried"] = json::object();
  for (const auto& [name, reason] : found.not_tried) {
    std::printf("not tried: %s, %s\n", name.c_str(), reason.c_str());
    whole["not_tried"][name] = reason;
  }
  if (file) file->commit(whole.dump(2) + '\n');
  if (model) model->commit(toYaml(found.model()));
  if (page)
    page->write(found, recorded.drives, recorded.options,
                {fileNames(options.bags.paths), originOf(values, options.bags.topics), recorded.change});
}

void diagnoseStruts(const po::variables_map& values) {
  AskedVehicle vehicle = readVehicle(values);
  DiagnoseOptions options;
  options.candidates = readEffects(values);
  options.threads = threadsOf(values);
  const KnownModels models = readModels(values, vehicle, options.candidates);
  std::optional<TextFile> file = outputFile(values, "json"), model = outputFile(values, "output");
  std::optional<VehiclePage> page;
  if (values.count(kReport) != 0) page.emplace(values[kReport].as<std::string>(), vehicle);

  VehicleOptions settings = VehicleOptions::fromValues(vehicle.layout, gatherOptions(values));
  TopicGaps gaps(settings.common.shell.input_timeout);
  const std::vector<VehicleDrive> drives = readDrives(values, vehicle, settings.common, gaps);
  Progress progress("searching", 1.0);
  options.progress = [&](double share) { progress.update(share); };
  const VehicleDiagnosis found = diagnoseVehicle(drives, vehicle.names, diagnoseOptionsOf(settings, options), models);
  gaps.explain([&] { requireOne(found, vehicle); });
  const std::vector<std::string> changes = changesOf(drives, vehicle.names, settings);
  progress.clear();
  json whole = tell(found, vehicle, changes);
  whole["silent"] = gaps.toJson();
  if (file) file->commit(whole.dump(2) + '\n');
  if (model) model->commit(modelText(found, vehicle));
  if (page)
    page->write(found, options, changes,
                {fileNames(values["bag"].as<std::vector<std::string>>()),
                 originOf(values, topicsOf(VehicleStreams(vehicle.layout)))});
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
  if (isOfVehicle(*values))
    diagnoseStruts(*values);
  else
    diagnoseStrut(*values);
  printWritten(*values, outputs);
}

}  // namespace suspension_health_monitor
