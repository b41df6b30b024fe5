// Prints the table of doc/forgetting.md of what a variable forgetting factor does to the judgement of health.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "../test/core/first_alarms.h"
#include "../test/core/healthy_day.h"
#include "../test/core/monitor_settings.h"
#include "../test/core/simulated_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr int kFirstSeed = 101, kNumSeeds = 60;
constexpr double kWarnDue = 67.0, kErrorDue = 94.0, kStepAt = 60.0, kHours = 24.0;  // of the paper's ramp [s]

MonitorSettings judgedWith(double slow, std::optional<double> fastest) {
  MonitorSettings options = optionsWith(slow, fastest);
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  return options;
}

double orNever(const std::optional<double>& time) { return time.value_or(std::numeric_limits<double>::infinity()); }

void printRamp(const char* scenario, const MonitorSettings& monitor) {
  std::vector<double> warns, errors, notices;
  for (int seed = kFirstSeed; seed < kFirstSeed + kNumSeeds; ++seed) {
    SimulationOptions options;
    options.scenario = scenario;
    options.seed = seed;
    const FirstAlarms first = firstAlarms(simulate(options), monitor);
    warns.push_back(orNever(first.warn) - kWarnDue);
    errors.push_back(orNever(first.error) - kErrorDue);
    notices.push_back(orNever(first.early));
  }
  std::printf(" %.1f, %.1f | %.1f, %.1f | %.0f |", meanOf(warns), *std::max_element(warns.begin(), warns.end()),
              meanOf(errors), *std::max_element(errors.begin(), errors.end()), meanOf(notices));
}

void printStep(const MonitorSettings& monitor) {
  std::vector<double> warns;
  for (int seed = kFirstSeed; seed < kFirstSeed + kNumSeeds; ++seed) {
    SimulationOptions options;
    options.seed = seed;
    options.ramp_start = kStepAt;
    options.ramp_end = kStepAt + 0.02;
    options.damping_end_fraction = 0.8;
    warns.push_back(orNever(firstAlarms(simulate(options), monitor).warn) - kStepAt);
  }
  std::printf(" %.1f |", medianOf(warns));
}

void printDay(const MonitorSettings& options) {
  const double half_width = 0.024 * std::sqrt(3.0);
  const DayCounts day = healthyDay(options, kHours, 1, std::uniform_real_distribution<double>(-half_width, half_width));
  std::printf(" %ld, %ld |\n", day.warn + day.error, day.early);
  std::fflush(stdout);
}

void printTable() {
  std::printf(
      "| lambda | ramp: WARN [s]: mean, most | ERROR [s] | early notice at [s] | the same with data loss | | | step of "
      "-20 %%: WARN after [s] | alarms, early notices in a healthy day |\n|---|---|---|---|---|---|---|---|---|\n");
  struct Setting {
    double slow;
    std::optional<double> fastest;
  };
  for (const Setting& setting : std::vector<Setting>{{0.99, {}}, {0.995, {}}, {0.99, 0.97}, {0.995, 0.97}}) {
    const MonitorSettings options = judgedWith(setting.slow, setting.fastest);
    std::printf(setting.fastest ? "| %g to %g |" : "| %g |", setting.slow, setting.fastest.value_or(0.0));
    printRamp("paper_clean", options);
    printRamp("paper_outliers", options);
    printStep(options);
    printDay(options);
  }
}

}  // namespace
}  // namespace suspension_health_monitor

int main() { suspension_health_monitor::printTable(); }
