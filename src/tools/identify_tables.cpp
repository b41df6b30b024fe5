#include <cmath>
#include <cstdio>
#include <string>

#include "json_of.h"
#include "results.h"
#include "suspension_health_monitor/internal/text.h"

namespace suspension_health_monitor {
namespace {

std::string cell(int width, int precision, double value) {
  return std::isnan(value) ? formatted("%*s", width, "-") : formatted("%*.*f", width, precision, value);
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

nlohmann::json toJson(const StrutEstimate& estimate) {
  nlohmann::json result = jsonOf(estimate);
  result["rows"] = estimate.effective_rows;
  result["valid"] = estimate.valid();
  result["reason"] = estimate.valid() ? "" : describe(estimate.doubt);
  result["natural_frequency"] = estimate.naturalFrequency();
  result["damping_ratio"] = estimate.dampingRatio();
  return result;
}

nlohmann::json toJson(const IdentifyResult& found, const std::string& change) {
  nlohmann::json result{{"samples", found.samples},
                        {"rows", found.rows},
                        {"gaps", found.gaps},
                        {"clock_jumps", found.clock_jumps},
                        {"sample_period", found.sample_period},
                        {"horizon_samples", found.horizon_samples},
                        {"warnings", found.warnings},
                        {"estimate", toJson(found.estimate)},
                        {"ls", toJson(found.ls)},
                        {"la", toJson(found.la)}};
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

nlohmann::json toJson(const WheelEstimate& estimate, const StrutEstimate& strut) {
  nlohmann::json result = jsonOf(estimate);
  result["wheel_hop_frequency"] = estimate.wheelHopFrequency();
  result["valid"] = estimate.valid();
  if (const auto ratio = massRatio(strut, estimate)) result["mass_ratio"] = *ratio;
  return result;
}

}  // namespace suspension_health_monitor
