#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "../ros/whole_file.h"
#include "bag_options.h"
#include "command.h"
#include "healthy_strut.h"
#include "identify_tables.h"
#include "long_work.h"
#include "recorded_strut.h"
#include "report_page.h"
#include "row_table.h"
#include "strut_settings.h"
#include "suspension_health_monitor/internal/digest.h"
#include "suspension_health_monitor/internal/monitor/drive_identification.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

constexpr std::size_t kTableLines = 12;

nlohmann::json toJson(const WheelEstimate& estimate, const StrutEstimate& strut) {
  nlohmann::json result{{"damping_to_wheel_mass", estimate.damping_to_wheel_mass},
                        {"stiffness_to_wheel_mass", estimate.stiffness_to_wheel_mass},
                        {"tyre_to_wheel_mass", estimate.tyre_to_wheel_mass},
                        {"damping_to_wheel_mass_stddev", estimate.damping_to_wheel_mass_stddev},
                        {"stiffness_to_wheel_mass_stddev", estimate.stiffness_to_wheel_mass_stddev},
                        {"tyre_to_wheel_mass_stddev", estimate.tyre_to_wheel_mass_stddev},
                        {"wheel_hop_frequency", estimate.wheelHopFrequency()},
                        {"valid", estimate.valid()}};
  if (const auto ratio = massRatio(strut, estimate)) result["mass_ratio"] = *ratio;
  return result;
}

void writeJson(std::FILE* out, const DriveIdentification& identification, const IdentifyResult& found,
               const RejectCounts& counts, const TopicGaps& gaps, const std::string& change) {
  const SuspensionMonitor& monitor = identification.monitor();
  nlohmann::json rejected = nlohmann::json::object();
  for (std::size_t i = 0; i < kRejectReasonNames.size(); ++i)
    rejected[std::string(kRejectReasonNames[i])] = counts.count(static_cast<RejectReason>(i));
  nlohmann::json result{{"samples", found.samples},
                        {"rows", found.rows},
                        {"gaps", found.gaps},
                        {"clock_jumps", found.clock_jumps},
                        {"alignment", identification.grid().streams().describeAlignment()},
                        {"bridged", identification.grid().streams().bridged()},
                        {"rejected", rejected},
                        {"silent", gaps.toJson()},
                        {"sample_period", found.sample_period},
                        {"mean_period", monitor.input().mean_period},
                        {"warnings", found.warnings},
                        {"horizon_samples", found.horizon_samples}};
  addEstimates(found, result);
  if (const TyreTracker* tyre = identification.tyre())
    result["tyre"] = {{"ls", toJson(tyre->report().ls, monitor.report().ls)},
                      {"la", toJson(tyre->report().la, monitor.report().la)}};
  if (!change.empty()) result["change"] = change;
  std::fprintf(out, "%s\n", result.dump(2).c_str());
}

void printEnd(const DriveIdentification& identification, const IdentifyResult& found,
              const std::optional<double>& mass) {
  std::printf("\n");
  printEstimates(found, mass);
  if (const TyreTracker* tyre = identification.tyre()) {
    const MonitorReport& strut = identification.monitor().report();
    printTyre("LS", tyre->report().ls, strut.ls);
    printTyre("LA", tyre->report().la, strut.la);
  }
}

std::string suspicions(const DriveIdentification& identification, const IdentifiedStrut& ls) {
  const SensorReport& sensor = identification.monitor().report().health.sensor;
  if (sensor.fault != SensorFault::kNone && sensor.fault != SensorFault::kUnrelated) return "; " + describe(sensor);
  return describeSuspicions(identification.grid().streams(), ls);
}

}  // namespace

void identify(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addVehicleOptions(description);
  auto add = description.add_options();
  add("csv", po::value<std::string>(), "write a line per regression row, full precision");
  add("output,o", po::value<std::string>(),
      "write horizon and nominal values, with the settings given, as YAML for the monitor and --config");
  add(kBaseline, po::value<std::string>(),
      "YAML file with the healthy strut, or settings with its nominal values, to say how this one is against it");
  const auto values = parse(arguments, "identify BAG... [OPTION]...", description, "bag");
  if (!values) return;
  const std::vector<std::string> outputs{"csv", "json", "output"};
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kBaseline}, outputs);
  if (isOfVehicle(*values)) {
    identifyStruts(*values);
    return printWritten(*values, outputs);
  }
  BagOptions options = readBagOptions(*values);
  takeHealthy(*values, options);
  const Baseline healthy = knownHealthy(options.healthy, options.pipeline);

  const Interruption interruption;
  std::optional<TextFile> csv = outputFile(*values, "csv"), json_file = outputFile(*values, "json"),
                          settings = outputFile(*values, "output");
  if (csv) RowTable::writeHead(csv->stream(), false);
  RowTable table(csv ? csv->stream() : nullptr, "");
  Digest<MonitorReport> digest(kTableLines);
  const PipelineOptions& pipeline = options.pipeline;
  RecordedIdentification recorded(options, [&](const MonitorReport& report) {
    table.add(report);
    if (report.has_row) digest.add(report);
  });
  TopicGaps gaps(pipeline.shell.input_timeout);
  recorded.read(gaps);
  DriveIdentification& identification = recorded.made();
  const RejectCounts rejected = recorded.rejected();
  gaps.explain([&] { requireRows(identification.monitor(), identification.grid().streams(), rejected); });
  table.finish();

  const IdentifyResult result = identification.result();
  const std::string change = describeChange(result, healthy, pipeline.monitor);
  if (json_file) writeJson(json_file->stream(), identification, result, rejected, gaps, change);
  if (json_file) json_file->commit();
  if (csv) csv->commit();
  const std::optional<StrutOfDrive> strut = strutOf(result);
  const std::string not_nominal = whyNotNominal(result, pipeline.monitor);
  if (settings && not_nominal.empty())
    settings->commit(settingsOf(*strut, gatherOptions(*values), fileNames(options.bags.paths)));
  const SuspensionMonitor& monitor = identification.monitor();
  gaps.print();
  printInput(monitor, identification.grid().streams(), options, rejected);
  printTable(digest.items());
  printEnd(identification, result, pipeline.monitor.sprung_mass);
  printChange(change);
  const auto reason = whyNotValid(result, pipeline.monitor);
  if (!reason)
    for (const std::string& warning : result.warnings) std::printf("warning: %s\n", warning.c_str());
  printWritten(*values, not_nominal.empty() ? outputs : std::vector<std::string>{"csv", "json"});
  if (settings && !not_nominal.empty() && !reason) throw TooLittleError("no settings are written: " + not_nominal);
  if (reason) throw TooLittleError(*reason + suspicions(identification, result.ls) + describeRejected(rejected));
}

}  // namespace suspension_health_monitor
