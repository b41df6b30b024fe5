#include "curve_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "html_page.h"
#include "recorded_drives.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

constexpr double kRows = 6.0;  // of a table, or up to twice as many
constexpr int kTitleWidth = 15;

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

}  // namespace

std::vector<StrutCurves> curvesOfBags(BagOptions options, const std::vector<IdentifyResult>& found) {
  TopicGaps gaps(options.settings.common.shell.input_timeout);
  std::vector<VehicleDrive> drives;
  for (VehicleBag& bag : readDrives(options, gaps)) drives.push_back(std::move(bag.drive));
  const SeparatedVehicle own = separateVehicle(drives, options.vehicle.names, options.period(), {});
  std::vector<StrutCurves> curves(found.size());
  for (const std::size_t i : options.vehicle.asked) {
    const StrutEstimate& linear = found[i].estimate;
    if (i < own.struts.size() && linear.damping_to_mass > 0.0 && linear.stiffness_to_mass > 0.0)
      curves[i] =
          strutCurves(own.struts[i], {linear.damping_to_mass, linear.stiffness_to_mass, {}, {}}, options.period());
  }
  return curves;
}

void printCurves(const StrutCurves& curves, const std::optional<double>& mass) {
  print("damper at [m/s]", curves.damper, 1.0, mass);
  print("spring at [mm]", curves.spring, 1e-3, mass);
}

void addCurves(const StrutCurves& curves, json& into) {
  into["damper_curve"] = toJson("velocity", curves.damper);
  into["spring_curve"] = toJson("travel", curves.spring);
}

json curveFindings(const AskedVehicle& vehicle, json whole, const std::string& source, const json& origin) {
  json struts = json::array();
  for (const std::size_t i : vehicle.asked) {
    const json& its = vehicle.resultsOf(i, whole);
    struts.push_back({{"strut", vehicle.names[i]}, {"against", its.value("against", json())}});
    for (const char* curve : {"damper_curve", "spring_curve"}) struts.back()[curve] = its[curve];
  }
  return {{"struts", shortened(struts)}, {"source", source}, {"origin", origin}};
}

}  // namespace suspension_health_monitor
