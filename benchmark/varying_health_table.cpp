// Prints the table of doc/forgetting.md of what a variable forgetting factor does to the judgement of health.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "../test/core/first_alarms.h"
#include "../test/core/paper_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr int kFirstSeed = 101, kNumSeeds = 60;
constexpr double kWarnDue = 67.0, kErrorDue = 94.0, kStepAt = 60.0, kHours = 24.0;  // of the paper's ramp [s]

MonitorOptions optionsWith(double slow, std::optional<double> fastest) {
  MonitorOptions options;
  options.sample_period = 0.02;
  options.forgetting_factor = slow;
  options.fastest_forgetting_factor = fastest;
  options.nominal_damping_to_mass = kPaperB1;
  options.nominal_stiffness_to_mass = kPaperB0;
  return options;
}

double orNever(const std::optional<double>& time) { return time.value_or(std::numeric_limits<double>::infinity()); }

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void printRamp(const char* scenario, const MonitorOptions& monitor) {
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
  std::printf(" %.1f, %.1f | %.1f, %.1f | %.0f |", mean(warns), *std::max_element(warns.begin(), warns.end()),
              mean(errors), *std::max_element(errors.begin(), errors.end()), mean(notices));
}

void printStep(const MonitorOptions& monitor) {
  std::vector<double> warns;
  for (int seed = kFirstSeed; seed < kFirstSeed + kNumSeeds; ++seed) {
    SimulationOptions options;
    options.seed = seed;
    options.ramp_start = kStepAt;
    options.ramp_end = kStepAt + 0.02;
    options.damping_end_fraction = 0.8;
    warns.push_back(orNever(firstAlarms(simulate(options), monitor).warn) - kStepAt);
  }
  std::sort(warns.begin(), warns.end());
  std::printf(" %.1f |", warns[warns.size() / 2]);
}

// The healthy day of doc/health.md: fresh noise, once a minute a second of zeros, twice in two minutes a bump.
void printDay(const MonitorOptions& options) {
  SimulationOptions drive;
  drive.scenario = "paper_saturation";
  drive.damping_ramp = false;
  drive.noise = 0.0;
  const std::vector<CornerSample> clean = simulate(drive);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-0.024 * std::sqrt(3.0), 0.024 * std::sqrt(3.0));
  SuspensionMonitor monitor(options);
  long alarms = 0, notices = 0;
  HealthReport before;
  for (Stamp stamp{}; toSeconds(stamp) < 3600.0 * kHours;)
    for (std::size_t k = 0; k + 1 < clean.size(); ++k, stamp += fromSeconds(0.02)) {
      CornerSample sample{stamp, clean[k].sprung_acceleration + noise(random),
                          clean[k].unsprung_acceleration + noise(random)};
      if (k % 3000 >= 1250 && k % 3000 < 1300) sample.sprung_acceleration = sample.unsprung_acceleration = 0.0;
      if (monitor.addSample(sample) == nullptr) continue;
      const HealthReport& now = monitor.report().health;
      const bool alarm = now.level == HealthLevel::kWarn || now.level == HealthLevel::kError;
      alarms += alarm && now.level != before.level ? 1 : 0;
      notices += now.early_warning && !before.early_warning ? 1 : 0;
      before = now;
    }
  std::printf(" %ld, %ld |\n", alarms, notices);
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
    const MonitorOptions options = optionsWith(setting.slow, setting.fastest);
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
