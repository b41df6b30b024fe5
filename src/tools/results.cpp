#include "results.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {

namespace {

std::string cell(int width, int precision, double value) {
  if (std::isfinite(value)) return formatted("%*.*f", width, precision, value);
  return formatted("%*s", width, std::isnan(value) ? "-" : "unknown");
}

// A negative stiffness has no frequency.
std::string describeOscillation(const StrutEstimate& estimate) {
  if (!(estimate.stiffness_to_mass > 0.0)) return "no natural frequency";
  return cell(0, 3, estimate.naturalFrequency()) + " Hz, damping ratio " + cell(0, 3, estimate.dampingRatio());
}

std::string describeHop(const WheelEstimate& estimate) {
  const double frequency = estimate.wheelHopFrequency();
  return std::isnan(frequency) ? "no wheel hop" : "wheel hop " + cell(0, 3, frequency) + " Hz";
}

json couplingJson(const std::vector<std::vector<double>>& ratios, const std::vector<std::string>& names) {
  json result = json::object();
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < names.size(); ++j)
      if (i != j) result[names[i]][names[j]] = ratios[i][j];
  return result;
}

constexpr double kCurveRows = 6.0;  // of a curve's table, or up to twice as many
constexpr int kCurveTitleWidth = 15;

/// @return 1, 2 or 5 times a power of ten, not above x > 0.
double roundedDown(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  return power * (x >= 5.0 * power ? 5.0 : x >= 2.0 * power ? 2.0 : 1.0);
}

/// @param shown  of the variable, in SI.
void printCurve(const char* title, const ForceCurve& curve, double shown, const std::optional<double>& mass) {
  if (curve.at.empty()) return void(std::printf("%s: the drives do not tell\n", title));
  std::printf("%-*s  %-20s  rebound, force [%s]\n", kCurveTitleWidth, title, "compression", mass ? "N" : "m/s^2");
  const double most = std::max(-curve.at.front(), curve.at.back()), step = roundedDown(most / kCurveRows);
  const auto entry = [&](double x) {
    return curve.covers(x) ? formatted("%9.4g +- %.2g", mass.value_or(1.0) * curve.forceAt(x),
                                       mass.value_or(1.0) * kNinetyPercent * curve.stddevAt(x))
                           : std::string("        -");
  };
  for (int i = 1; i * step <= most; ++i)
    std::printf("%*.4g  %-20s  %s\n", kCurveTitleWidth, i * step / shown, entry(i * step).c_str(),
                entry(-i * step).c_str());
}

json toJson(const char* variable, const ForceCurve& curve) {
  return {{variable, curve.at}, {"force", curve.force}, {"stddev", curve.stddev}};
}

}  // namespace

void printTable(const std::vector<MonitorReport>& reports) {
  std::printf("                   damping/mass [1/s]           stiffness/mass [1/s^2]           free run\n");
  std::printf(
      "    time [s]  estimate       LS       LA   estimate         LS         LA rmse [m/s^2]  fit [%%]   valid\n");
  for (const MonitorReport& report : reports)
    std::printf("%12.2f %s %s %s %s %s %s %s %s   %s\n", toSeconds(report.stamp),
                cell(9, 4, report.estimate.damping_to_mass).c_str(), cell(8, 4, report.ls.damping_to_mass).c_str(),
                cell(8, 4, report.la.damping_to_mass).c_str(), cell(10, 4, report.estimate.stiffness_to_mass).c_str(),
                cell(10, 4, report.ls.stiffness_to_mass).c_str(), cell(10, 4, report.la.stiffness_to_mass).c_str(),
                cell(12, 4, report.comparison.rmse).c_str(), cell(8, 1, report.comparison.fit_percent).c_str(),
                report.estimate.valid() ? "yes" : "no");
}

void printResult(const char* name, const StrutEstimate& estimate, const std::optional<double>& mass) {
  const std::string doubt = estimate.valid() ? "" : "  NOT VALID: " + describe(estimate.doubt);
  if (std::isnan(estimate.damping_to_mass)) {
    std::printf("%s: nothing is known%s\n", name, doubt.c_str());
    return;
  }
  std::printf("%s: damping/mass %s +- %s 1/s, stiffness/mass %s +- %s 1/s^2, %s%s\n", name,
              cell(0, 4, estimate.damping_to_mass).c_str(), cell(0, 4, estimate.dampingAbsoluteStddev()).c_str(),
              cell(0, 4, estimate.stiffness_to_mass).c_str(), cell(0, 4, estimate.stiffnessAbsoluteStddev()).c_str(),
              describeOscillation(estimate).c_str(), doubt.c_str());
  if (mass)
    std::printf("    damping %.4g N s/m, stiffness %.5g N/m\n", *mass * estimate.damping_to_mass,
                *mass * estimate.stiffness_to_mass);
}

void printEstimates(const IdentifyResult& found, const std::optional<double>& mass) {
  std::printf("over the whole drive, %.0f blocks:\n", found.estimate.effective_rows);
  printResult("estimate", found.estimate, mass);
  std::printf("at its end, over the last %.0f rows:\n", found.la.effective_rows);
  printResult("LS", found.ls, mass);
  printResult("LA", found.la, mass);
}

json toJson(const StrutEstimate& estimate) {
  json result = jsonOf(estimate);
  result["damping_to_mass_stddev"] = jsonOf(estimate.dampingAbsoluteStddev());
  result["stiffness_to_mass_stddev"] = jsonOf(estimate.stiffnessAbsoluteStddev());
  result["rows"] = estimate.effective_rows;
  result["valid"] = estimate.valid();
  result["reason"] = estimate.valid() ? "" : describe(estimate.doubt);
  result["known_to"] = estimate.knownTo();
  result["natural_frequency"] = estimate.naturalFrequency();
  result["damping_ratio"] = estimate.dampingRatio();
  return result;
}

json toJson(const IdentifyResult& found, const std::string& change) {
  json result = jsonOf(found);
  result["estimate"] = toJson(found.estimate);
  result["ls"] = toJson(found.ls);
  result["la"] = toJson(found.la);
  result["iv"] = result["estimate"];  // until the next version
  if (!change.empty()) result["change"] = change;
  return result;
}

void printChange(const std::string& change) {
  if (!change.empty()) std::printf("%s\n", change.c_str());
}

void printTyre(const char* name, const WheelEstimate& estimate, const StrutEstimate& strut) {
  const char* const doubt = estimate.valid() ? "" : "  NOT VALID: too little or too poor excitation";
  if (std::isnan(estimate.damping_to_wheel_mass)) {
    std::printf("%s: nothing is known of the wheel%s\n", name, doubt);
    return;
  }
  std::printf(
      "%s: damping/wheel mass %s +- %s 1/s, stiffness/wheel mass %s +- %s 1/s^2, tyre/wheel mass %s +- %s 1/s^2, "
      "%s%s\n",
      name, cell(0, 4, estimate.damping_to_wheel_mass).c_str(),
      cell(0, 4, estimate.damping_to_wheel_mass_stddev).c_str(), cell(0, 2, estimate.stiffness_to_wheel_mass).c_str(),
      cell(0, 2, estimate.stiffness_to_wheel_mass_stddev).c_str(), cell(0, 2, estimate.tyre_to_wheel_mass).c_str(),
      cell(0, 2, estimate.tyre_to_wheel_mass_stddev).c_str(), describeHop(estimate).c_str(), doubt);
  if (const auto ratio = massRatio(strut, estimate)) std::printf("    wheel mass / body mass %.4f\n", *ratio);
}

json toJson(const WheelEstimate& estimate, const StrutEstimate& strut) {
  json result = jsonOf(estimate);
  result["wheel_hop_frequency"] = estimate.wheelHopFrequency();
  result["valid"] = estimate.valid();
  if (const auto ratio = massRatio(strut, estimate)) result["mass_ratio"] = *ratio;
  return result;
}

void printCoupling(const VehicleCoupling& coupling, const std::vector<std::string>& names) {
  for (const KnownForceCoefficients& force : coupling.forces) {
    std::printf("one unit of %s accelerates the tops by [m/s^2]:", force.name.c_str());
    for (std::size_t i = 0; i < names.size(); ++i)
      std::printf("%s %s %.4g +- %.2g", i > 0 ? "," : "", names[i].c_str(), force.values[i], force.stddevs[i]);
    std::printf("\n");
  }
  if (names.size() < 2) return;
  std::printf("how much of what a strut does to its own top reaches the others:\n%16s", "moved by");
  for (const std::string& name : names) std::printf("  %14s", name.c_str());
  std::printf("\n");
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::printf("%16s", names[i].c_str());
    for (std::size_t j = 0; j < names.size(); ++j)
      if (i == j)
        std::printf("  %14s", "1");
      else
        std::printf("  %6.3f +-%6.3f", coupling.ratios[i][j], coupling.stddevs[i][j]);
    std::printf("\n");
  }
  if (!std::isnan(coupling.model_error))
    std::printf("a rigid body on linear struts leaves %.2g %% of it unexplained\n", 100.0 * coupling.model_error);
  for (const AntiRollBarFound& bar : coupling.bars)
    std::printf("anti-roll bar between %s and %s: stiffness/mass %.4g and %.4g 1/s^2\n", names[bar.first].c_str(),
                names[bar.second].c_str(), bar.first_stiffness_to_mass, bar.second_stiffness_to_mass);
}

void printCurves(const StrutCurves& curves, const std::optional<double>& mass) {
  printCurve("damper at [m/s]", curves.damper.absolute(), 1.0, mass);
  printCurve("spring at [mm]", curves.spring.absolute(), 1e-3, mass);
}

void addCurves(const StrutCurves& curves, json& into) {
  into["damper_curve"] = toJson("velocity", curves.damper.absolute());
  into["spring_curve"] = toJson("travel", curves.spring.absolute());
}

json wholeJson(const AskedVehicle& vehicle, const VehicleCoupling& coupling, const TopicGaps& gaps) {
  json whole{{"silent", gaps.toJson()}};
  if (vehicle.isStrutAlone()) return whole;
  const std::vector<std::string>& names = vehicle.names;
  whole["struts"] = json::object();
  whole["known_forces"] = json::object();
  whole["coupling"] = couplingJson(coupling.ratios, names);
  whole["coupling_stddevs"] = couplingJson(coupling.stddevs, names);
  whole["model_error"] = coupling.model_error;
  whole["anti_roll_bars"] = json::array();
  for (const AntiRollBarFound& bar : coupling.bars)
    whole["anti_roll_bars"].push_back(
        {{"struts", {names[bar.first], names[bar.second]}},
         {"stiffness_to_mass",
          {{names[bar.first], bar.first_stiffness_to_mass}, {names[bar.second], bar.second_stiffness_to_mass}}}});
  for (const KnownForceCoefficients& force : coupling.forces)
    for (std::size_t i = 0; i < names.size(); ++i) {
      whole["known_forces"][force.name]["coefficients"][names[i]] = force.values[i];
      whole["known_forces"][force.name]["stddevs"][names[i]] = force.stddevs[i];
    }
  return whole;
}

void printBody(const BodyInertia& body) {
  if (body.doubt != InertiaDoubt::kNone) {
    std::printf("%s\n", describe(body.doubt).c_str());
    return;
  }
  std::printf(
      "M/Iyy %.4g +- %.2g 1/m^2, M/Ixx %.4g +- %.2g 1/m^2, centre of gravity %.3g +- %.2g m ahead and %.3g +- %.2g m "
      "to the left of where positions count from\n",
      body.mass_to_pitch_inertia.value, body.mass_to_pitch_inertia.stddev, body.mass_to_roll_inertia.value,
      body.mass_to_roll_inertia.stddev, body.x.value, body.x.stddev, body.y.value, body.y.stddev);
}

json toJson(const BodyInertia& body) {
  if (body.doubt != InertiaDoubt::kNone) return {{"reason", describe(body.doubt)}};
  return {{"mass_to_pitch_inertia", body.mass_to_pitch_inertia.value},
          {"mass_to_pitch_inertia_stddev", body.mass_to_pitch_inertia.stddev},
          {"mass_to_roll_inertia", body.mass_to_roll_inertia.value},
          {"mass_to_roll_inertia_stddev", body.mass_to_roll_inertia.stddev},
          {"centre_of_gravity", {body.x.value, body.y.value}},
          {"centre_of_gravity_stddev", {body.x.stddev, body.y.stddev}}};
}

}  // namespace suspension_health_monitor
