#include <cmath>
#include <cstdio>

#include "command.h"
#include "csv_table.h"
#include "html_page.h"
#include "recorded_drives.h"
#include "recorded_monitor.h"
#include "results.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/math/digest.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {

SHM_FIELDS(CurveChange::Range, from, to, softer)

namespace {

constexpr std::size_t kTableLines = 12;

/// Reads bags as drives and fits curves, from the linear struts that identify found.
/// @param found  by strut.  @return likewise; empty curves where nothing was found, or is not asked for.
std::vector<StrutCurves> curvesOfBags(BagOptions options, const std::vector<IdentifyResult>& found) {
  TopicGaps gaps(options.settings.common.shell.input_timeout);
  const SeparatedVehicle own =
      separateVehicle(readDrives(options, gaps).drives, options.vehicle.names, options.period(), {});
  std::vector<StrutCurves> curves(found.size());
  for (const std::size_t i : options.vehicle.asked) {
    const StrutEstimate& linear = found[i].estimate;
    if (i < own.struts.size() && linear.damping_to_mass > 0.0 && linear.stiffness_to_mass > 0.0)
      curves[i] = strutCurves(own.struts[i], {linear.damping_to_mass, linear.stiffness_to_mass, {}, {}},
                              options.period(), own.coupling.modelErrorOf(i));
  }
  return curves;
}

json toJson(const std::optional<double>& change, double stddev) {
  if (!change) return nullptr;
  const double half = kNinetyPercent * stddev, log = std::log1p(*change);
  return {{"change", *change}, {"interval", {std::expm1(log - half), std::expm1(log + half)}}};
}

/// What is known of a strut from one drive.
struct StrutThere {
  const IdentifyResult& found;
  const StrutCurves& curves;
};

/// @param bag  name of that of `then`.
json against(const std::string& bag, const StrutThere& now, const StrutThere& then, double payload_range) {
  json result{{"bag", bag}};
  addCurves(then.curves, result);
  const std::optional<StrutOfDrive> today = strutOf(now.found), before = strutOf(then.found);
  if (!today || !before) {
    result["change"] =
        "cannot be compared with " + bag + ": no valid estimate of " + (before ? "this drive" : "that drive");
    return result;
  }
  const DriveChange change = changeOf(today->strut, now.curves, before->strut, then.curves, payload_range);
  const StrutChange& strut = change.strut;
  result.update({{"change", describe(change, bag)},
                 {"damping", toJson(strut.damping, strut.damping_stddev)},
                 {"stiffness", toJson(strut.stiffness, strut.stiffness_stddev)},
                 {"payload_change", strut.payload ? json(*strut.payload) : json()},
                 {"damper_differences", jsonOf(change.damper.ranges)},
                 {"spring_differences", jsonOf(change.spring.ranges)}});
  return result;
}

/// Identifies the bag of --against with all other options as they are, and compares every strut with itself there.
/// @param now, curves  by strut, of the drives that it is compared with.
/// @return by strut `bag`, its curves there, `change` in a sentence and, with valid estimates of both, the numbers of
/// it; empty if --against is not given.
/// @throws std::invalid_argument, InputError, TooLittleError  as identify, with the bag's name before.
std::vector<json> againstOther(po::variables_map values, const std::vector<IdentifyResult>& now,
                               const std::vector<StrutCurves>& curves) {
  std::vector<json> changes;
  if (values.count(kAgainst) == 0) return changes;
  const std::vector<std::string> bags{values[kAgainst].as<std::string>()};
  values.at("bag").value() = bags;
  const std::string bag = fileNames(bags).front();
  try {
    const BagOptions options = readBagOptions(values);
    RecordedMonitor recorded(options, HealthyStruts(options.vehicle.names.size()), false);
    recorded.read();
    const std::vector<IdentifyResult> then = recorded.identified().struts;
    const std::vector<StrutCurves> curves_then = curvesOfBags(options, then);
    for (std::size_t i = 0; i < now.size(); ++i)
      changes.push_back(against(bag, {now[i], curves[i]}, {then[i], curves_then[i]},
                                options.settings.struts[i].monitor.payload_range));
  } catch (const TooLittleError& error) {
    throw TooLittleError(std::string("--") + kAgainst + ' ' + bag + ": " + error.what());
  }
  return changes;
}

/// What the page of curves is made of.
/// @param values  of the command that makes it.  @param whole  what was found, as --json has it.
json curveFindings(const po::variables_map& values, const BagOptions& options, json whole) {
  const AskedVehicle& vehicle = options.vehicle;
  json struts = json::array();
  for (const std::size_t i : vehicle.asked) {
    const json& its = vehicle.resultsOf(i, whole);
    struts.push_back({{"strut", vehicle.names[i]}, {"against", its.value("against", json())}});
    for (const char* curve : {"damper_curve", "spring_curve"}) struts.back()[curve] = its[curve];
  }
  return {{"struts", shortened(struts)},
          {"source", join(fileNames(options.bags.paths))},
          {"origin", originOf(values, namesOf(options.bags.topics))}};
}

/// What is known at the end.
struct Found {
  Found(RecordedMonitor& recorded, const BagOptions& options, const HealthyStruts& healthy)
      : vehicle(recorded.identified()) {
    for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
      const PipelineOptions& strut = options.settings.struts[i];
      changes.push_back(describeChange(vehicle.struts[i], knownHealthy(healthy[i], strut), strut.monitor));
    }
    for (const std::size_t i : options.vehicle.asked) {
      const std::string lack = whyNotNominal(vehicle.struts[i], options.settings.struts[i].monitor);
      if (lack.empty())
        nominal.emplace(options.vehicle.names[i], *strutOf(vehicle.struts[i]));
      else
        lacks.push_back(options.vehicle.prefix(i, ": ") + lack);
    }
    if (changes.size() > 1) body = inertiaOf(recorded.monitor().body(), recorded.monitor().vehicle()->places());
  }

  VehicleIdentification vehicle;
  std::vector<std::string> changes;             // by strut, against the healthy one
  std::map<std::string, StrutOfDrive> nominal;  // the struts that may be what health is judged by
  std::vector<std::string> lacks;               // what is the matter with the others
  std::optional<BodyInertia> body;
  std::vector<StrutCurves> curves;  // by strut, if they are asked for
  std::vector<json> against;        // by strut, if there is another drive
};

json toJson(const RecordedMonitor& recorded, const Found& found) {
  json whole = wholeJson(recorded.vehicle(), found.vehicle.coupling, recorded.gaps());
  whole["alignment"] = describeAlignment(recorded.grid());
  whole["bridged"] = recorded.grid().bridged();
  const RejectCounts counts = recorded.pipeline().rejected();
  for (std::size_t i = 0; i < kRejectReasonNames.size(); ++i)
    whole["rejected"][std::string(kRejectReasonNames[i])] = counts.count(static_cast<RejectReason>(i));
  if (found.body) whole["body"] = toJson(*found.body);
  for (const std::size_t i : recorded.vehicle().asked) {
    json& its = recorded.vehicle().resultsOf(i, whole);
    its.update(toJson(found.vehicle.struts[i], found.changes[i]));
    if (!found.curves.empty()) addCurves(found.curves[i], its);
    if (!found.against.empty()) its["against"] = found.against[i];
    its["mean_period"] = recorded.strut(i).input().mean_period;
  }
  const ModelReport& report = recorded.strut(0).report();
  if (const TyreTracker* tyre = recorded.pipeline().tyre())
    whole["tyre"] = {{"ls", toJson(tyre->report().ls, report.ls)}, {"la", toJson(tyre->report().la, report.la)}};
  return whole;
}

/// @param table  of the one strut that is asked for.
void print(const RecordedMonitor& recorded, const Found& found, const std::vector<MonitorReport>& table) {
  const AskedVehicle& vehicle = recorded.vehicle();
  recorded.printInput();
  printCoupling(found.vehicle.coupling, vehicle.names);
  if (found.body) printBody(*found.body);
  const std::string mistake = describeMistake(recorded.monitor(), vehicle.names);
  if (!mistake.empty()) std::printf("warning: %s\n", mistake.c_str());
  if (vehicle.only) {
    std::printf("\n");
    printTable(table);
  }
  for (const std::size_t i : vehicle.asked) {
    const MonitorReport& report = recorded.strut(i).report();
    std::printf("\n%s", vehicle.prefix(i, ", ").c_str());
    const std::optional<double> mass = recorded.strut(i).options().sprung_mass;
    printEstimates(found.vehicle.struts[i], mass);
    if (!found.curves.empty()) printCurves(found.curves[i], mass);
    if (const TyreTracker* tyre = recorded.pipeline().tyre()) {
      printTyre("LS", tyre->report().ls, report.ls);
      printTyre("LA", tyre->report().la, report.la);
    }
    printChange(found.changes[i]);
    if (!found.against.empty()) printChange(found.against[i]["change"]);
    for (const std::string& warning : found.vehicle.struts[i].warnings)
      if (warning != mistake) std::printf("warning: %s\n", warning.c_str());
  }
}

/// @param fault  of a sensor, that is said beside it.
/// @return why the strut is not known, neither over the whole drive nor at its end, in words; empty: it is.
std::string whyNotValid(const IdentifyResult& found, const MonitorOptions& options, SensorFault fault) {
  if (found.estimate.valid() || found.now.valid()) return "";
  if (found.estimate.effective_rows > 0.0)
    return "no estimate is valid: " + describeDoubt(found.estimate, options.enough());
  constexpr double kLengths = (kBlockWindows.front() + 1) / 2.0;  // of blocks that overlap by half
  const double enough = kLengths * MonitorSettings(options).presentBlockLength();
  if (static_cast<double>(found.samples) * found.sample_period < enough)
    return "there is no estimate: too short" + describeEnough(enough);
  if (fault == SensorFault::kOtherAxis) return "there is no estimate";
  return std::string("there is no estimate: too little motion, ") + (found.gaps > 0 ? "too many gaps, " : "") +
         "or not the two sides of one strut";
}

std::string suspicions(const RecordedMonitor& recorded, std::size_t strut, const BagOptions& options) {
  if (options.one_frequency) return ". " + describe(*options.one_frequency);
  if (const std::optional<double>& late = options.clock_offset)
    return formatted("; the IMUs' clocks seem to differ by %.0f ms: diagnose tells", 1e3 * std::abs(*late));
  return describeSuspicions(recorded.strut(strut).report(),
                            recorded.vehicle().isStrutAlone() ? &recorded.grid() : nullptr);
}

/// @throws TooLittleError  if no strut that is asked for is known.
void requireValid(const RecordedMonitor& recorded, const std::vector<IdentifyResult>& found,
                  const BagOptions& options) {
  const AskedVehicle& vehicle = recorded.vehicle();
  std::vector<std::string> reasons;
  for (const std::size_t i : vehicle.asked) {
    const std::string reason =
        whyNotValid(found[i], options.settings.struts[i].monitor, recorded.strut(i).report().health.sensor.fault);
    if (reason.empty()) return;
    reasons.push_back(vehicle.prefix(i, ": ") + reason + suspicions(recorded, i, options));
  }
  const std::string mistake = describeMistake(recorded.monitor(), vehicle.names);
  throw TooLittleError((mistake.empty() ? join(reasons, "; ") : mistake) +
                       describeRejected(recorded.pipeline().rejected()));
}

void identifyBags(const po::variables_map& values) {
  const BagOptions options = readBagOptions(values);
  const AskedVehicle& vehicle = options.vehicle;
  const HealthyStruts healthy = healthyOf(values, options);
  std::optional<TextFile> csv = outputFile(values, "csv"), findings = outputFile(values, "json");
  std::optional<TextFile> settings = outputFile(values, "output");
  std::optional<HtmlPage> page = reportPage(values);
  RowTable rows(csv ? csv->stream() : nullptr, vehicle);
  Digest<MonitorReport> table(kTableLines);
  RecordedMonitor recorded(options, healthy, false, [&](std::size_t strut, const MonitorReport& report) {
    rows.add(strut, report);
    if (vehicle.only == strut && report.has_row) table.add(report);
  });
  recorded.read();
  rows.finish();
  Found found(recorded, options, healthy);
  if (values.count("curves") + values.count(kAgainst) + values.count(kReport) != 0)
    found.curves = curvesOfBags(options, found.vehicle.struts);
  found.against = againstOther(values, found.vehicle.struts, found.curves);
  const json whole = toJson(recorded, found);
  if (findings) findings->commit(whole.dump(2) + '\n');
  if (csv) csv->commit();
  if (page) page->write(curvesTemplate(), curveFindings(values, options, whole));
  const bool has_settings = settings && !found.nominal.empty();
  if (has_settings)
    settings->commit(
        settingsOf(found.nominal, vehicle.only.has_value(), givenSettings(values), fileNames(options.bags.paths)));
  print(recorded, found, table.items());
  if (has_settings)
    for (const std::string& lack : found.lacks) std::printf("warning: no settings of %s\n", lack.c_str());
  std::vector<std::string> outputs{"csv", "json", kReport};
  if (has_settings) outputs.emplace_back("output");
  printWritten(values, outputs);
  requireValid(recorded, found.vehicle.struts, options);
  if (settings && !has_settings) throw TooLittleError("no settings are written: " + join(found.lacks, "; "));
}

}  // namespace

void identify(const Arguments& arguments) {
  po::options_description description = bagOptions();
  auto add = description.add_options();
  add("csv", po::value<std::string>(), "write a line per regression row, full precision");
  add("output,o", po::value<std::string>(),
      "write horizon and nominal values, with the settings given, as YAML for the monitor and --config");
  add("curves", "fit the curves of damper and spring, too: reads the bags once more");
  add(kAgainst, po::value<std::string>(),
      "bag of another drive with the same topics, to say by how much and where on the curves this one differs");
  add(kReport, po::value<std::string>(), "write DIR/report.html: the curves, of both drives, as a page with figures");
  add(kBaseline, po::value<std::string>(),
      "YAML file with the healthy strut, or settings with its nominal values, to say how this one is against it");
  runOnBags(arguments, "identify BAG... [OPTION]...", description, {"csv", "json", "output", kReport}, &identifyBags);
}

}  // namespace suspension_health_monitor
