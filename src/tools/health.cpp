#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "checked_imus.h"
#include "command.h"
#include "csv_table.h"
#include "html_page.h"
#include "recorded_monitor.h"
#include "results.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/blocks/block_bins.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/math/digest.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {

SHM_FIELDS(RecordedMonitor::Recording, name, from)

namespace {

/// What the monitor says over time, and what it judges by then: evenly thinned, so that neither memory nor the page
/// grows with the drive.
using HealthCourse = Digest<std::pair<HealthMoment, Baseline>>;

constexpr std::size_t kMostPoints = 4000;  // more than twice a screen's pixels

/// Writes a line of --csv.
void writeLine(CsvTable& table, std::size_t strut, const HealthMoment& moment) {
  const StrutEstimate& estimate = moment.estimate;
  std::fprintf(table.beginLine(strut, moment.time), "%s,\"%s\",%.17g,%.17g,%.17g,%.17g,%.17g\n", nameOf(moment.level),
               boost::replace_all_copy(moment.message, "\"", "\"\"").c_str(), estimate.damping_to_mass,
               estimate.stiffness_to_mass, estimate.dampingAbsoluteStddev(), estimate.stiffnessAbsoluteStddev(),
               moment.offset);
}

json toJson(const HealthCourse& course) {
  json time = json::array(), damping, stiffness;
  for (const char* curve : {"value", "stddev", "healthy"}) damping[curve] = stiffness[curve] = json::array();
  for (const auto& [moment, judged_by] : course.items()) {
    const auto add = [valid = moment.estimate.valid()](double value, double stddev, const auto& healthy, json& into) {
      constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();  // null in JSON: no line there
      into["value"].push_back(valid ? value : kNothing);
      into["stddev"].push_back(valid ? stddev : kNothing);
      into["healthy"].push_back(healthy.value_or(kNothing));
    };
    const StrutEstimate& its = moment.estimate;
    time.push_back(std::round(1e3 * toSeconds(moment.elapsed)) / 1e3);
    add(its.damping_to_mass, its.damping_to_mass_stddev, judged_by.damping_to_mass, damping);
    add(its.stiffness_to_mass, its.stiffness_to_mass_stddev, judged_by.stiffness_to_mass, stiffness);
  }
  return {{"time", time}, {"damping", shortened(damping)}, {"stiffness", shortened(stiffness)}};
}

void printBlocks(const StrutEstimate& estimate, const std::optional<double>& mass) {
  printResult("estimate", estimate, mass);
  if (estimate.friction)
    std::printf("    dry friction %.3g +- %.1g m/s^2\n", estimate.friction->force, estimate.friction->stddev);
  if (std::abs(estimate.delay) > kProven * estimate.delay_stddev && estimate.explained > kBlockTuning.nearly_all)
    std::printf("    the wheel carrier's readings are stamped %.3g +- %.1g ms late\n", 1e3 * estimate.delay,
                1e3 * estimate.delay_stddev);
  if (!std::isnan(estimate.age))
    std::printf("    explains %.1f %% of the body's motion, from %.3g s of data, on average %.3g s old\n",
                100.0 * estimate.explained, estimate.window, estimate.age);
}

void printRows(const char* name, const StrutEstimate& estimate, const std::optional<double>& mass) {
  printResult(name, estimate, mass);
  if (!std::isnan(estimate.offset))
    std::printf("    offset of the wheel carrier's IMU against the body's %.3g m/s^2\n", estimate.offset);
}

/// A line per change of level, then the times, and the estimates at the end.
void printHealth(const HealthLog& log, const SuspensionMonitor& monitor, const std::string& reference) {
  std::printf("judged by %s\n\n", reference.c_str());
  std::printf("%15s  %10s  %-5s  %s\n", "time [s]", "after [s]", "level", "reason");
  for (const HealthMoment& event : log.events())
    std::printf("%15.2f  %10.2f  %-5s  %s\n", toSeconds(event.time), toSeconds(event.elapsed), nameOf(event.level),
                event.message.c_str());
  std::printf("\nlevel    time [s]   share   events\n");
  const double covered = toSeconds(log.elapsed());
  for (const HealthLevel level : kHealthLevels) {
    const double seconds = toSeconds(log.duration(level));
    std::printf("%-5s  %10.2f  %4.0f %%  %7zu\n", nameOf(level), seconds,
                covered > 0.0 ? 100.0 * seconds / covered : 0.0, log.count(level));
  }
  std::printf("early warnings %zu", log.earlyWarnings().size());
  if (!log.earlyWarnings().empty()) std::printf(", the first at %.2f s", toSeconds(log.earlyWarnings().front().time));
  const HealthMoment end = log.latest();
  std::printf("\n\nat the end %s: %s\n", nameOf(end.level), end.message.c_str());
  printBlocks(monitor.report().estimate, monitor.options().sprung_mass);
  printRows("LS", monitor.report().ls, monitor.options().sprung_mass);
  printRows("LA", monitor.report().la, monitor.options().sprung_mass);
}

json toJson(const HealthLog& log, const SuspensionMonitor& monitor) {
  json result{{"events", jsonOf(log.events())},
              {"end", jsonOf(log.latest())},
              {"warn_events", log.count(HealthLevel::kWarn)},
              {"error_events", log.count(HealthLevel::kError)},
              {"early_warnings", log.earlyWarnings().size()}};
  for (const HealthLevel level : kHealthLevels) result["seconds"][nameOf(level)] = toSeconds(log.duration(level));
  const ModelReport& end = monitor.report();
  for (const auto& [name, estimate] : {std::pair("estimate", &end.estimate), {"ls", &end.ls}, {"la", &end.la}})
    result[name] = toJson(*estimate);
  return result;
}

/// What the page has of a strut.
/// @param result  as --json has it.
json findingsOf(const RecordedMonitor& recorded, std::size_t strut, const HealthCourse& course,
                const std::vector<RecordedMonitor::Recording>& recordings, json result) {
  const SuspensionMonitor& monitor = recorded.strut(strut);
  const HealthLog& log = recorded.log(strut);
  const MonitorSettings& settings = monitor.options();
  const double duration = toSeconds(log.elapsed());
  result.update({{"strut", recorded.vehicle().names[strut]},
                 {"source", sourceOf(namesOf(recordings), duration, monitor.period())},
                 {"horizon", monitor.horizonSamples() * monitor.period()},
                 {"judged_by", recorded.reference(strut)},
                 {"recordings", jsonOf(recordings)},
                 {"duration", duration},
                 {"early_warnings", jsonOf(log.earlyWarnings())},
                 {"thresholds",
                  {{"damping", {settings.damping_warn, settings.damping_error}},
                   {"stiffness", {settings.stiffness_warn, settings.stiffness_error}}}},
                 {"course", toJson(course)}});
  return result;
}

/// @return the corners over all the drives; nothing of other vehicles.
std::optional<CornerComparisonReport> cornersOf(RecordedMonitor& recorded) {
  const std::optional<CornerPlaces> places = cornersAmong(recorded.vehicle().names);
  if (!places) return {};
  std::array<CornerState, kNumCorners> corners;
  for (std::size_t i = 0; i < kNumCorners; ++i)
    corners[i] = {recorded.overTheDrive((*places)[i]), recorded.strut((*places)[i]).baseline()};
  return compareCorners(corners);
}

json toJson(const CornerComparisonReport& corners) {
  json damages = json::array();
  for (const CornerDamage& damage : corners.damages)
    damages.push_back({{"corner", kCornerNames[damage.corner]},
                       {"part", corners.verdicts[damage.corner] == CornerVerdict::kDamper ? "damping" : "stiffness"},
                       {"change", damage.change},
                       {"stddev_of_log", damage.stddev}});
  return {{"level", nameOf(corners.level)}, {"message", describe(corners)}, {"damages", damages}};
}

void watchBags(const po::variables_map& values) {
  const BagOptions options = readLiveOptions(values);
  const AskedVehicle& vehicle = options.vehicle;
  HealthyStruts healthy = healthyOf(values, options);
  std::optional<TextFile> findings = outputFile(values, "json"), csv = outputFile(values, "csv");
  std::optional<HtmlPage> page = reportPage(values);
  CsvTable table(csv ? csv->stream() : nullptr, vehicle, "level,message,b1,b0,b1_stddev,b0_stddev,offset");
  std::vector<HealthCourse> courses(vehicle.names.size(), HealthCourse(kMostPoints));
  RecordedMonitor recorded(options, std::move(healthy), true, {},
                           [&](std::size_t strut, const HealthMoment& moment, const Baseline& judged_by) {
                             if (table.isOf(strut)) writeLine(table, strut, moment);
                             if (page) courses[strut].add({moment, judged_by});
                           });
  const std::vector<RecordedMonitor::Recording> recordings = recorded.read();
  const VehicleCoupling coupling = couplingOf(recorded.monitor(), vehicle.names, options.settings.forceNames());
  json whole = wholeJson(vehicle, coupling, recorded.gaps()), struts = json::array();
  for (const std::size_t i : vehicle.asked) {
    const json result = toJson(recorded.log(i), recorded.strut(i));
    vehicle.resultsOf(i, whole).update(result);
    if (page) struts.push_back(findingsOf(recorded, i, courses[i], recordings, result));
  }
  const std::optional<CornerComparisonReport> corners = cornersOf(recorded);
  if (corners) whole["corners"] = toJson(*corners);
  if (findings) findings->commit(whole.dump(2) + '\n');
  if (csv) csv->commit();
  if (page)
    page->write(healthTemplate(), {{"struts", struts},
                                   {"corners", whole.value("corners", json())},
                                   {"data", shortened(dataJson(options))},
                                   {"origin", originOf(values, namesOf(options.bags.topics))}});
  recorded.printInput();
  for (const std::size_t i : vehicle.asked) {
    std::printf("\n%s", vehicle.prefix(i, ", ").c_str());
    printHealth(recorded.log(i), recorded.strut(i), recorded.reference(i));
  }
  if (corners) std::printf("\nover the drive: %s\n", describe(*corners).c_str());
  printWritten(values, {"csv", "json", kReport});
}

}  // namespace

void health(const Arguments& arguments) {
  po::options_description description = bagOptions();
  auto add = description.add_options();
  add(kBaseline, po::value<std::string>(),
      "YAML file with the healthy strut, as the monitor writes it, or settings with nominal values; of a vehicle "
      "struts: {NAME: ...}");
  add("csv", po::value<std::string>(), "write a line per second and change of level, full precision");
  add(kReport, po::value<std::string>(), "write DIR/report.html: the levels over time as a page with figures");
  runOnBags(arguments, "health BAG... [OPTION]...", description, {"csv", "json", kReport}, &watchBags);
}

}  // namespace suspension_health_monitor
