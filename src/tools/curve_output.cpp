#include "curve_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "command.h"
#include "html_page.h"
#include "recorded_drives.h"
#include "recorded_monitor.h"
#include "results.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {

SHM_FIELDS(CurveChange::Range, from, to, softer)

namespace {

constexpr double kRows = 6.0;  // of a table, or up to twice as many
constexpr int kTitleWidth = 15;
constexpr double kNinetyPercent = 1.645;  // standard deviations

/// @return 1, 2 or 5 times a power of ten, not above x > 0.
double roundedDown(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  return power * (x >= 5.0 * power ? 5.0 : x >= 2.0 * power ? 2.0 : 1.0);
}

/// @param shown  of the variable, in SI.
void print(const char* title, const ForceCurve& curve, double shown, const std::optional<double>& mass) {
  if (curve.at.empty()) return void(std::printf("%s: the drives do not tell\n", title));
  std::printf("%-*s  %-20s  rebound, force [%s]\n", kTitleWidth, title, "compression", mass ? "N" : "m/s^2");
  const double most = std::max(-curve.at.front(), curve.at.back()), step = roundedDown(most / kRows);
  const auto cell = [&](double x) {
    return curve.covers(x) ? formatted("%9.4g +- %.2g", mass.value_or(1.0) * curve.forceAt(x),
                                       mass.value_or(1.0) * kNinetyPercent * curve.stddevAt(x))
                           : std::string("        -");
  };
  for (int i = 1; i * step <= most; ++i)
    std::printf("%*.4g  %-20s  %s\n", kTitleWidth, i * step / shown, cell(i * step).c_str(), cell(-i * step).c_str());
}

json toJson(const char* variable, const ForceCurve& curve) {
  return {{variable, curve.at}, {"force", curve.force}, {"stddev", curve.stddev}};
}

json toJson(const std::optional<double>& change, double stddev) {
  if (!change) return nullptr;
  const double half = kNinetyPercent * stddev, log = std::log1p(*change);
  return {{"change", *change}, {"interval", {std::expm1(log - half), std::expm1(log + half)}}};
}

/// Compares what is known of a strut from one drive with what is known of it from another.
/// @param bag  name of that of `then`.
json against(const std::string& bag, const IdentifyResult& now, const StrutCurves& curves_now,
             const IdentifyResult& then, const StrutCurves& curves_then, double payload_range) {
  json result{{"bag", bag}};
  addCurves(curves_then, result);
  const std::optional<StrutOfDrive> today = strutOf(now), before = strutOf(then);
  if (!today || !before) {
    result["change"] =
        "cannot be compared with " + bag + ": no valid estimate of " + (before ? "this drive" : "that drive");
    return result;
  }
  const DriveChange change = changeOf(today->strut, curves_now, before->strut, curves_then, payload_range);
  const StrutChange& strut = change.strut;
  result.update({{"change", describe(change, bag)},
                 {"damping", toJson(strut.damping, strut.damping_stddev)},
                 {"stiffness", toJson(strut.stiffness, strut.stiffness_stddev)},
                 {"payload_change", strut.payload ? json(*strut.payload) : json()},
                 {"damper_differences", jsonOf(change.damper.ranges)},
                 {"spring_differences", jsonOf(change.spring.ranges)}});
  return result;
}

}  // namespace

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

void printCurves(const StrutCurves& curves, const std::optional<double>& mass) {
  print("damper at [m/s]", curves.damper.absolute(), 1.0, mass);
  print("spring at [mm]", curves.spring.absolute(), 1e-3, mass);
}

void addCurves(const StrutCurves& curves, json& into) {
  into["damper_curve"] = toJson("velocity", curves.damper.absolute());
  into["spring_curve"] = toJson("travel", curves.spring.absolute());
}

void printTravel(const TravelStatistics& travel) {
  if (travel.travel.edges.empty()) return;
  std::printf("travel up to %.3g mm in compression and %.3g mm in rebound, up to %.3g and %.3g m/s\n",
              1e3 * travel.travel.compression.largest, 1e3 * travel.travel.rebound.largest,
              travel.travel_rate.compression.largest, travel.travel_rate.rebound.largest);
  for (const StopUse& stop : travel.stops)
    std::printf("%s at %.3g mm: hit %d times, %s of the time in the last tenth before it or in it\n",
                stop.effect.c_str(), 1e3 * stop.gap, stop.hits, percent(stop.near).c_str());
}

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
      changes.push_back(
          against(bag, now[i], curves[i], then[i], curves_then[i], options.settings.struts[i].monitor.payload_range));
  } catch (const TooLittleError& error) {
    throw TooLittleError(std::string("--") + kAgainst + ' ' + bag + ": " + error.what());
  }
  return changes;
}

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

}  // namespace suspension_health_monitor
