#include <cstdio>
#include <nlohmann/json.hpp>

#include "bag_options.h"
#include "command.h"
#include "healthy_strut.h"
#include "identify_tables.h"
#include "long_work.h"
#include "recorded_vehicle.h"
#include "report_page.h"
#include "row_table.h"
#include "strut_settings.h"
#include "survey.h"
#include "suspension_health_monitor/internal/prefixed.h"
#include "vehicle_bags.h"
#include "vehicle_tables.h"
#include "watched_vehicle.h"

namespace suspension_health_monitor {
namespace {

nlohmann::json toJson(const IdentifyResult& found) {
  nlohmann::json result{{"samples", found.samples},
                        {"rows", found.rows},
                        {"gaps", found.gaps},
                        {"clock_jumps", found.clock_jumps},
                        {"sample_period", found.sample_period},
                        {"horizon_samples", found.horizon_samples},
                        {"warnings", found.warnings}};
  addEstimates(found, result);
  return result;
}

std::vector<Baseline> healthyStruts(const boost::program_options::variables_map& values, const AskedVehicle& vehicle,
                                    VehicleOptions& settings) {
  const std::vector<std::optional<HealthyStrut>> given = takeHealthy(values, vehicle, settings);
  std::vector<Baseline> healthy;
  for (std::size_t i = 0; i < given.size(); ++i)
    prefixed("struts/" + vehicle.names[i] + ": ",
             [&] { healthy.push_back(knownHealthy(given[i], settings.struts[i])); });
  return healthy;
}

std::string settingsText(const std::map<std::string, StrutOfDrive>& struts, const OptionMap& given,
                         const boost::program_options::variables_map& values, const AskedVehicle& vehicle) {
  if (struts.empty()) throw TooLittleError("no estimate is valid: there are no settings to write");
  const std::vector<std::string> drives = fileNames(values["bag"].as<std::vector<std::string>>());
  if (!vehicle.only) return settingsOf(struts, given, drives);
  const auto& [name, strut] = *struts.begin();
  return settingsOf(strut, settingsFor(name, given), drives);
}

}  // namespace

void identifyStruts(const boost::program_options::variables_map& values) {
  const Interruption interruption;
  std::optional<TextFile> file = outputFile(values, "json"), csv = outputFile(values, "csv"),
                          settings_file = outputFile(values, "output");
  AskedVehicle vehicle = readVehicle(values);
  const OptionMap given = gatherOptions(values);
  VehicleOptions settings = VehicleOptions::fromValues(vehicle.layout, given);
  const std::vector<Baseline> healthy = healthyStruts(values, vehicle, settings);
  TopicGaps gaps(settings.common.shell.input_timeout);
  ImuBags bags = readBags(values, settings.common.shell);
  const VehicleStreams streams = streamsOf(bags, settings.common, vehicle.layout);
  if (settings.common.monitor.sample_period) requireFittingPeriod(bags, *settings.common.monitor.sample_period);
  bags.gaps = &gaps;
  std::vector<RowTable> rows;
  for (std::size_t i = 0; i < vehicle.names.size(); ++i)
    rows.emplace_back(csv && (!vehicle.only || *vehicle.only == i) ? csv->stream() : nullptr,
                      vehicle.only ? "" : vehicle.names[i]);
  if (csv) RowTable::writeHead(csv->stream(), !vehicle.only);
  const std::vector<WatchedStrut> watched = plainStruts(vehicle.names.size());
  WatchedVehicle recorded(settings, streams, watched, bags.transforms.get(), {},
                          [&](std::size_t strut, const MonitorReport& report) { rows[strut].add(report); });
  recorded.read(bags);
  for (RowTable& table : rows) table.finish();
  recorded.printInput();
  gaps.print();
  const std::vector<std::string> forces = settings.forceNames();
  VehicleIdentification found;
  gaps.explain([&] { found = recorded.identified(vehicle.names, forces); });
  printCoupling(found.coupling, vehicle.names);
  nlohmann::json whole = toJson(found.coupling, vehicle.names);
  whole["silent"] = gaps.toJson();
  if (vehicle.names.size() > 1) {
    const BodyInertiaResult body = inertiaOf(recorded.monitor().body(), recorded.monitor().tops()->places());
    printBody(body);
    whole["body"] = toJson(body);
  }
  std::map<std::string, StrutOfDrive> struts;
  for (const std::size_t i : vehicle.asked) {
    const IdentifyResult& strut = found.struts[i];
    const PipelineOptions& its_settings = settings.struts[i];
    std::printf("\n%s, ", vehicle.names[i].c_str());
    printEstimates(strut, its_settings.monitor.sprung_mass);
    const std::string change = describeChange(strut, healthy[i], its_settings.monitor);
    printChange(change);
    if (const std::optional<StrutOfDrive> its = strutOf(strut)) {
      const std::string not_nominal = whyNotNominal(strut, its_settings.monitor);
      if (not_nominal.empty())
        struts.emplace(vehicle.names[i], *its);
      else if (settings_file)
        std::printf("warning: no settings of it are written: %s\n", not_nominal.c_str());
    }
    for (const std::string& warning : strut.warnings) std::printf("warning: %s\n", warning.c_str());
    nlohmann::json& result = whole["struts"][vehicle.names[i]] = toJson(strut);
    if (!change.empty()) result["change"] = change;
  }
  if (csv) csv->commit();
  if (file) file->commit(whole.dump(2) + '\n');
  if (settings_file) settings_file->commit(settingsText(struts, given, values, vehicle));
}

}  // namespace suspension_health_monitor
