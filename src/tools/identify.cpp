#include <cstdio>

#include "bag_options.h"
#include "command.h"
#include "csv_tables.h"
#include "long_work.h"
#include "recorded_strut.h"
#include "results.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/monitor/drive_identification.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "watched_vehicle.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;
using nlohmann::json;

constexpr std::size_t kTableLines = 12;

/// The files that are asked for, begun.
struct Files {
  /// @param struts  names of a vehicle's, for a column; empty: one strut.
  Files(const po::variables_map& values, const std::vector<std::string>& struts)
      : csv(outputFile(values, "csv")),
        findings(outputFile(values, "json")),
        settings(outputFile(values, "output")),
        rows(csv ? csv->stream() : nullptr, struts) {}

  void commitTables(const json& whole) {
    if (findings) findings->commit(whole.dump(2) + '\n');
    if (csv) csv->commit();
  }

  std::optional<TextFile> csv, findings, settings;
  RowTable rows;
};

json toJson(RecordedMonitor& recorded, const IdentifyResult& found, const std::string& change) {
  const MonitorReport& report = recorded.monitor().report();
  const StreamGrid& streams = recorded.grid();
  const RejectCounts counts = recorded.rejected();
  json whole = toJson(found, change);
  whole.update({{"alignment", streams.describeAlignment()},
                {"bridged", streams.bridged()},
                {"silent", recorded.gaps().toJson()},
                {"mean_period", recorded.monitor().input().mean_period}});
  for (std::size_t i = 0; i < kRejectReasonNames.size(); ++i)
    whole["rejected"][std::string(kRejectReasonNames[i])] = counts.count(static_cast<RejectReason>(i));
  if (const TyreTracker* tyre = recorded.strut().tyre())
    whole["tyre"] = {{"ls", toJson(tyre->report().ls, report.ls)}, {"la", toJson(tyre->report().la, report.la)}};
  return whole;
}

void printWarnings(const IdentifyResult& found) {
  for (const std::string& warning : found.warnings) std::printf("warning: %s\n", warning.c_str());
}

/// @return why the strut is not known, neither over the whole drive nor at its end, in words; empty: it is.
std::string whyNotValid(const IdentifyResult& found, const MonitorOptions& options) {
  if (found.estimate.valid || found.now.valid) return "";
  if (found.estimate.rows > 0.0) return "no estimate is valid: " + found.estimate.reason;
  constexpr double kLengths = (BlockEstimator::kWindows[0] + 1) / 2.0;  // of blocks that overlap by half
  const double enough = kLengths * MonitorSettings(options).presentBlockLength();
  if (static_cast<double>(found.samples) * found.sample_period < enough)
    return "there is no estimate: too short" + describeEnough(enough);
  return std::string("there is no estimate: too little motion, ") + (found.gaps > 0 ? "too many gaps, " : "") +
         "or not the two sides of one strut";
}

std::string suspicions(const RecordedMonitor& recorded, const IdentifiedStrut& ls) {
  const SensorReport& sensor = recorded.monitor().report().health.sensor;
  if (sensor.fault != SensorFault::kNone && sensor.fault != SensorFault::kUnrelated) return "; " + describe(sensor);
  return describeSuspicions(recorded.grid(), ls);
}

void identifyStrut(const po::variables_map& values) {
  const BagOptions options = readBagOptions(values);
  const MonitorOptions& settings = options.pipeline.monitor;
  const Baseline healthy = knownHealthy(healthyOf(values, options.pipeline), options.pipeline);
  Files files(values, {});
  Digest<MonitorReport> digest(kTableLines);
  RecordedMonitor recorded(options, {}, {}, [&](const MonitorReport& report) {
    files.rows.add(0, report);
    if (report.has_row) digest.add(report);
  });
  recorded.read();
  files.rows.finish();
  VehiclePipeline& strut = recorded.strut();
  IdentifyResult found = identified(recorded.monitor(), strut.overTheDrive(), strut.rejected());
  const std::vector<std::string> faults = recorded.mountFaults();
  found.warnings.insert(found.warnings.end(), faults.begin(), faults.end());
  const std::string change = describeChange(found, healthy, settings);
  files.commitTables(toJson(recorded, found, change));
  std::string not_nominal = whyNotNominal(found, settings);
  if (not_nominal.empty() && !faults.empty()) not_nominal = "mend a sensor first: " + faults.front();
  if (files.settings && not_nominal.empty())
    files.settings->commit(settingsOf(*strutOf(found), monitorSettings(values), fileNames(options.bags.paths)));
  recorded.printInput();
  printTable(digest.items());
  std::printf("\n");
  printEstimates(found, settings.sprung_mass);
  if (const TyreTracker* tyre = strut.tyre()) {
    printTyre("LS", tyre->report().ls, recorded.monitor().report().ls);
    printTyre("LA", tyre->report().la, recorded.monitor().report().la);
  }
  printChange(change);
  const std::string not_valid = whyNotValid(found, settings);
  if (not_valid.empty()) printWarnings(found);
  std::vector<std::string> outputs{"csv", "json"};
  if (not_nominal.empty()) outputs.emplace_back("output");
  printWritten(values, outputs);
  if (!not_valid.empty())
    throw TooLittleError(not_valid + suspicions(recorded, found.ls) + describeRejected(recorded.rejected()));
  if (files.settings && !not_nominal.empty()) throw TooLittleError("no settings are written: " + not_nominal);
}

std::string settingsText(const std::map<std::string, StrutOfDrive>& struts, const OptionMap& given,
                         const po::variables_map& values, const AskedVehicle& vehicle) {
  if (struts.empty()) throw TooLittleError("no estimate is valid: there are no settings to write");
  const std::vector<std::string> drives = fileNames(values["bag"].as<std::vector<std::string>>());
  if (!vehicle.only) return settingsOf(struts, given, drives);
  const auto& [name, strut] = *struts.begin();
  return settingsOf(strut, settingsFor(name, given), drives);
}

void identifyStruts(const po::variables_map& values) {
  AskedVehicle vehicle = readVehicle(values);
  const OptionMap given = gatherOptions(values);
  const VehicleOptions settings = VehicleOptions::fromValues(vehicle.layout, given);
  const std::vector<std::optional<HealthyStrut>> healthy = healthyOf(values, vehicle, settings);
  Files files(values, vehicle.only ? std::vector<std::string>{} : vehicle.names);
  WatchedVehicle recorded(values, vehicle, settings, plainStruts(vehicle.names.size()), {},
                          [&](std::size_t strut, const MonitorReport& report) {
                            if (!vehicle.only) files.rows.add(strut, report);
                            if (vehicle.only == strut) files.rows.add(0, report);
                          });
  recorded.requirePeriod();
  recorded.read();
  files.rows.finish();
  recorded.printInput();
  const VehicleIdentification found = recorded.identified();
  printCoupling(found.coupling, vehicle.names);
  json whole = toJson(found.coupling, vehicle.names);
  whole["silent"] = recorded.gaps().toJson();
  if (vehicle.names.size() > 1) {
    const BodyInertiaResult body = inertiaOf(recorded.monitor().body(), recorded.monitor().tops()->places());
    printBody(body);
    whole["body"] = toJson(body);
  }
  std::map<std::string, StrutOfDrive> struts;
  for (const std::size_t i : vehicle.asked) {
    const IdentifyResult& strut = found.struts[i];
    const MonitorOptions& its_settings = settings.struts[i].monitor;
    std::printf("\n%s, ", vehicle.names[i].c_str());
    printEstimates(strut, its_settings.sprung_mass);
    const std::string change = describeChange(strut, knownHealthy(healthy[i], settings.struts[i]), its_settings);
    printChange(change);
    if (const std::optional<StrutOfDrive> its = strutOf(strut)) {
      const std::string not_nominal = whyNotNominal(strut, its_settings);
      if (not_nominal.empty())
        struts.emplace(vehicle.names[i], *its);
      else if (files.settings)
        std::printf("warning: no settings of it are written: %s\n", not_nominal.c_str());
    }
    printWarnings(strut);
    whole["struts"][vehicle.names[i]] = toJson(strut, change);
  }
  files.commitTables(whole);
  if (files.settings) files.settings->commit(settingsText(struts, given, values, vehicle));
  printWritten(values, {"csv", "json", "output"});
}

}  // namespace

void identify(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  auto add = description.add_options();
  add("csv", po::value<std::string>(), "write a line per regression row, full precision");
  add("output,o", po::value<std::string>(),
      "write horizon and nominal values, with the settings given, as YAML for the monitor and --config");
  add(kBaseline, po::value<std::string>(),
      "YAML file with the healthy strut, or settings with its nominal values, to say how this one is against it");
  const auto values = parse(arguments, "identify BAG... [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kBaseline}, {"csv", "json", "output"});
  const Interruption interruption;
  if (isOfVehicle(*values))
    identifyStruts(*values);
  else
    identifyStrut(*values);
}

}  // namespace suspension_health_monitor
