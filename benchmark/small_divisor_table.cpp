// Prints the table of doc/defaults.md: the error of LS and LA in the paper's experiments against the forgetting factor
// and the smallest residual that LA divides by.
#include <cstdio>
#include <string>
#include <vector>

#include "../test/core/estimation_error.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr int kNumSeeds = 20;
constexpr const char* kScenarios[] = {"paper_clean", "paper_outliers", "paper_saturation"};
constexpr double kForgettingFactors[] = {0.98, 0.985, 0.99, 0.995};

struct Divisor {
  const char* name;
  SmallDivisor rule;
  double value;
};
constexpr double kRelative[] = {0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0};

std::vector<Divisor> divisors() {
  std::vector<Divisor> result{{"absolute", SmallDivisor::kAbsolute, 1e-8}};
  for (const double share : kRelative) result.push_back({"relative", SmallDivisor::kRelative, share});
  return result;
}

struct Setting {
  std::string name;
  MonitorSettings options;
};

std::vector<Setting> settings() {
  std::vector<Setting> result{{"all settings of the paper", paperOptions()}};
  for (const double forgetting_factor : kForgettingFactors) {
    for (const Divisor& divisor : divisors()) {
      MonitorSettings options;
      options.sample_period = 0.02;
      options.forgetting_factor = forgetting_factor;
      options.estimators.small_divisor_rule = divisor.rule;
      options.estimators.small_divisor = divisor.value;
      char name[64];
      std::snprintf(name, sizeof name, "%g, %s %g", forgetting_factor, divisor.name, divisor.value);
      result.push_back({name, options});
    }
  }
  return result;
}

/// Errors by setting: the median over the drives of one scenario.
std::vector<EstimatorErrors> errorsIn(const std::string& scenario, const std::vector<Setting>& settings) {
  std::vector<std::vector<EstimatorErrors>> by_setting(settings.size());
  for (int seed = 1; seed <= kNumSeeds; ++seed) {
    const std::vector<DriveSample> drive = paperExperiment(scenario, seed);
    for (std::size_t i = 0; i < settings.size(); ++i) by_setting[i].push_back(rmsErrors(drive, settings[i].options));
  }
  std::vector<EstimatorErrors> medians;
  for (const std::vector<EstimatorErrors>& errors : by_setting) medians.push_back(medianOf(errors));
  return medians;
}

void printTable() {
  const std::vector<Setting> rows = settings();
  std::vector<std::vector<EstimatorErrors>> by_scenario;
  for (const char* scenario : kScenarios) by_scenario.push_back(errorsIn(scenario, rows));
  std::printf(
      "| lambda, small divisor | no fault: LS | LA | data loss: LS | LA | end stops: LS | LA |\n"
      "|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::printf("| %s |", rows[i].name.c_str());
    for (const std::vector<EstimatorErrors>& medians : by_scenario)
      for (const ParameterError& error : {medians[i].ls, medians[i].la})
        std::printf(" %.3f, %.3f |", error.damping_to_mass, error.stiffness_to_mass);
    std::printf("\n");
  }
}

int command(const Arguments&) { return printTable(), 0; }

const AddTable kAdded("small_divisor", {"", command});

}  // namespace
}  // namespace suspension_health_monitor
