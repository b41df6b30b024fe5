#include <cstdio>

#include "bag_options.h"
#include "command.h"
#include "healthy_strut.h"
#include "identify_tables.h"
#include "long_work.h"
#include "recorded_vehicle.h"
#include "results.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"
#include "vehicle_page.h"
#include "vehicle_tables.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

/// @throws TooLittleError  if there is nothing to be said of any strut that is asked for.
void requireOne(const VehicleDiagnosis& found, const AskedVehicle& vehicle) {
  requireCoupling(found.coupling);
  for (const std::size_t i : vehicle.asked)
    if (found.struts[i]) return;
  const std::size_t first = vehicle.asked.front();
  throw TooLittleError(vehicle.names[first] + ": the drives " + found.struts[first].reason);
}

void print(const VehicleDiagnosis& found, const AskedVehicle& vehicle, const std::vector<std::string>& changes) {
  std::printf("%s\n", found.summary.c_str());
  printCoupling(found.coupling, vehicle.names);
  for (const std::size_t i : vehicle.asked) {
    const Diagnosis& strut = found.struts[i];
    std::printf("\n%s: ", vehicle.names[i].c_str());
    if (strut)
      printSearch(strut);
    else
      std::printf("the drives %s\n", strut.reason.c_str());
    printChange(changes[i]);
  }
}

json toJson(const VehicleDiagnosis& found, const AskedVehicle& vehicle, const std::vector<std::string>& changes,
            const TopicGaps& gaps) {
  json whole = toJson(found.coupling, vehicle.names);
  whole["silent"] = gaps.toJson();
  whole["verdict"] = nameOf(found.verdict);
  whole["summary"] = found.summary;
  whole["selected"] = json::object();
  for (const std::size_t i : vehicle.asked) {
    const Diagnosis& strut = found.struts[i];
    json& its = whole["struts"][vehicle.names[i]] = strut ? toJson(strut) : json{{"reason", strut.reason}};
    whole["selected"][vehicle.names[i]] = its["selected"] = found.selected(i);
    if (strut) its["verdict"] = nameOf(found.verdictOn(i));
    if (!changes[i].empty()) its["change"] = changes[i];
  }
  return whole;
}

KnownModels modelsOf(const VehicleDiagnosis& found) {
  KnownModels models;
  for (const Diagnosis& strut : found.struts)
    models.push_back(strut ? std::optional<StrutModel>(strut.model()) : std::nullopt);
  return models;
}

}  // namespace

void diagnoseStruts(const boost::program_options::variables_map& values) {
  const Interruption interruption;
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
  print(found, vehicle, changes);
  if (file) file->commit(toJson(found, vehicle, changes, gaps).dump(2) + '\n');
  if (model) model->commit(toYaml(modelsOf(found), vehicle));
  if (page)
    page->write(found, options, changes,
                {fileNames(values["bag"].as<std::vector<std::string>>()),
                 originOf(values, topicsOf(VehicleStreams(vehicle.layout)))});
}

}  // namespace suspension_health_monitor
