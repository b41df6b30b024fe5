#include <cmath>
#include <cstdio>
#include <deque>

#include "command.h"
#include "csv_table.h"
#include "curve_output.h"
#include "html_page.h"
#include "recorded_monitor.h"
#include "results.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/math/digest.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kTableLines = 12;

/// The table of --csv: one line per regression row. The comparison of a row's sample comes some samples after the row:
/// lines wait for it, and go without when their series ends before.
class RowTable : CsvTable {
 public:
  /// As CsvTable.
  RowTable(std::FILE* out, const AskedVehicle& vehicle)
      : CsvTable(out, vehicle,
                 "ls_damping_to_mass,ls_stiffness_to_mass,la_damping_to_mass,la_stiffness_to_mass,"
                 "measured,predicted,residual,estimate_damping_to_mass,estimate_stiffness_to_mass,"
                 "estimate_damping_to_mass_stddev,estimate_stiffness_to_mass_stddev"),
        waiting_(vehicle.names.size()) {}

  void add(std::size_t strut, const MonitorReport& report) {
    if (!isOf(strut)) return;
    std::deque<MonitorReport>& waiting = waiting_[strut];
    const bool clock_went_back = !waiting.empty() && report.stamp < waiting.back().stamp;
    while (clock_went_back && !waiting.empty()) write(strut, std::nullopt);
    if (report.has_row) waiting.push_back(report);
    const ComparisonReport& comparison = report.comparison;
    while (comparison.has_sample && !waiting.empty() && waiting.front().stamp <= comparison.stamp)
      write(strut, waiting.front().stamp == comparison.stamp ? comparison.predicted : std::nullopt);
  }

  /// No more comparisons will come.
  void finish() {
    for (std::size_t strut = 0; strut < waiting_.size(); ++strut)
      while (!waiting_[strut].empty()) write(strut, std::nullopt);
  }

 private:
  void write(std::size_t strut, const std::optional<double>& predicted) {
    const MonitorReport row = waiting_[strut].front();
    waiting_[strut].pop_front();
    const double prediction = predicted.value_or(std::nan(""));
    std::fprintf(beginLine(strut, row.stamp), "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
                 row.ls.damping_to_mass, row.ls.stiffness_to_mass, row.la.damping_to_mass, row.la.stiffness_to_mass,
                 row.measured, prediction, row.measured - prediction, row.estimate.damping_to_mass,
                 row.estimate.stiffness_to_mass, row.estimate.damping_to_mass_stddev,
                 row.estimate.stiffness_to_mass_stddev);
  }

  std::vector<std::deque<MonitorReport>> waiting_;  // by strut, with a row
};

/// What is known at the end.
struct Found {
  Found(RecordedMonitor& recorded, const BagOptions& options, const HealthyStruts& healthy)
      : vehicle(recorded.identified()) {
    for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
      const PipelineOptions& strut = options.settings.struts[i];
      changes.push_back(describeChange(vehicle.struts[i], knownHealthy(healthy[i], strut), strut.monitor));
    }
    if (changes.size() > 1) body = inertiaOf(recorded.monitor().body(), recorded.monitor().vehicle()->places());
  }

  VehicleIdentification vehicle;
  std::vector<std::string> changes;  // by strut, against the healthy one
  std::optional<BodyInertiaResult> body;
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

/// The struts that may be what health is judged by, and what is the matter with the others.
struct Nominal {
  std::map<std::string, StrutOfDrive> struts;
  std::vector<std::string> lacks;

  Nominal(const RecordedMonitor& recorded, const std::vector<IdentifyResult>& found, const VehicleOptions& settings) {
    for (const std::size_t i : recorded.vehicle().asked) {
      const std::string lack = whyNotNominal(found[i], settings.struts[i].monitor);
      if (lack.empty())
        struts.emplace(recorded.vehicle().names[i], *strutOf(found[i]));
      else
        lacks.push_back(recorded.vehicle().prefix(i, ": ") + lack);
    }
  }
};

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
  const Nominal nominal(recorded, found.vehicle.struts, options.settings);
  const bool has_settings = settings && !nominal.struts.empty();
  if (has_settings)
    settings->commit(
        settingsOf(nominal.struts, vehicle.only.has_value(), givenSettings(values), fileNames(options.bags.paths)));
  print(recorded, found, table.items());
  if (has_settings)
    for (const std::string& lack : nominal.lacks) std::printf("warning: no settings of %s\n", lack.c_str());
  std::vector<std::string> outputs{"csv", "json", kReport};
  if (has_settings) outputs.emplace_back("output");
  printWritten(values, outputs);
  requireValid(recorded, found.vehicle.struts, options);
  if (settings && !has_settings) throw TooLittleError("no settings are written: " + join(nominal.lacks, "; "));
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
