// Prints how soon the judgement of health finds a change of the damping, and how often it
// finds one in a healthy strut.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "../test/core/first_alarms.h"
#include "../test/core/healthy_day.h"

namespace suspension_health_monitor {
namespace {

constexpr double kRate = 100.0;  // [Hz]
constexpr double kChangeAt = 80.0, kDuration = 180.0;
constexpr int kNumSeeds = 3;
constexpr double kGoldenB1 = 6.0, kGoldenB0 = 63.3;

struct Change {
  const char* name;
  double left;      // share of the damping
  double duration;  // [s]
};
constexpr Change kChanges[] = {{"none", 1.0, 0.02},         {"-10 %", 0.9, 0.02}, {"-20 %", 0.8, 0.02},
                               {"-30 %", 0.7, 0.02},        {"-50 %", 0.5, 0.02}, {"-20 % in 60 s", 0.8, 60.0},
                               {"-50 % in 60 s", 0.5, 60.0}};

struct Road {
  std::string iso_class;
  double speed;
};

/// First time after the change at which something was said [s]; infinite: never. `before` it: false alarms.
struct Delays {
  std::vector<double> early, warn, error;
  int false_early = 0, false_warn = 0, false_error = 0;
  double hours_before = 0.0, stale = 0.0, samples = 0.0;
};

MonitorSettings optionsFor(double period, double b1, double b0) {
  MonitorSettings options;
  options.sample_period = period;
  options.integration_horizon = b0 > 30.0 ? 0.3 : 0.6;  // near what suspension_bag horizon proposes
  options.forgetting_factor = 1.0 - period / 2.0;       // 2 s
  options.nominal_damping_to_mass = b1;
  options.nominal_stiffness_to_mass = b0;
  return options;
}

void judge(const std::vector<CornerSample>& drive, const MonitorSettings& options, bool changes, Delays& delays) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double early = kNever, warn = kNever, error = kNever;
  const double end_of_healthy = changes ? kChangeAt : kDuration;
  SuspensionMonitor monitor(options);
  HealthReport before;
  for (const CornerSample& sample : drive) {
    const MonitorReport* report = monitor.addSample(sample);
    const double t = toSeconds(sample.stamp);
    if (report == nullptr || t < 15.0) continue;
    const HealthReport& now = report->health;
    const auto at_least = [&](HealthLevel level) { return now.level >= level && now.level != HealthLevel::kStale; };
    delays.samples += 1.0;
    delays.stale += now.level == HealthLevel::kStale ? 1.0 : 0.0;
    if (t < end_of_healthy) {
      delays.false_early += now.early_warning && !before.early_warning ? 1 : 0;
      delays.false_warn += now.level == HealthLevel::kWarn && before.level != now.level ? 1 : 0;
      delays.false_error += now.level == HealthLevel::kError && before.level != now.level ? 1 : 0;
    } else {
      if (now.early_warning) early = std::min(early, t - kChangeAt);
      if (at_least(HealthLevel::kWarn)) warn = std::min(warn, t - kChangeAt);
      if (at_least(HealthLevel::kError)) error = std::min(error, t - kChangeAt);
    }
    before = now;
  }
  delays.hours_before += (end_of_healthy - 15.0) / 3600.0;
  if (!changes) return;
  delays.early.push_back(early);
  delays.warn.push_back(warn);
  delays.error.push_back(error);
}

Delays judgeAll(const Road& road, const Change& change, double mass) {
  Delays delays;
  for (int seed = 1; seed <= kNumSeeds; ++seed) {
    SimulationOptions options;
    options.scenario = "iso_road";
    options.iso_class = road.iso_class;
    options.speed = road.speed;
    options.rate = kRate;
    options.duration = kDuration;
    options.seed = seed;
    options.damping_to_mass = kGoldenB1 / mass;
    options.stiffness_to_mass = kGoldenB0 / mass;
    options.damping_end_fraction = change.left;
    options.ramp_start = kChangeAt;
    options.ramp_end = kChangeAt + change.duration;
    judge(simulate(options), optionsFor(1.0 / kRate, kGoldenB1, kGoldenB0), change.left < 1.0, delays);
  }
  return delays;
}

std::string median(std::vector<double> delays) {
  if (delays.empty()) return "-";
  std::sort(delays.begin(), delays.end());
  const double middle = delays[delays.size() / 2];
  if (std::isinf(middle)) return "never";
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", middle);
  return text;
}

void printRow(const char* first, const Change& change, const Delays& delays) {
  const double hours = delays.hours_before;
  std::printf("| %s | %s | %s | %s | %s | %.1f | %.1f | %.1f | %.0f %% |\n", first, change.name,
              median(delays.early).c_str(), median(delays.warn).c_str(), median(delays.error).c_str(),
              delays.false_early / hours, delays.false_warn / hours, delays.false_error / hours,
              100.0 * delays.stale / std::max(1.0, delays.samples));
  std::fflush(stdout);
}

constexpr const char* kHead =
    "change | early notice [s] | WARN [s] | ERROR [s] | false notices/h | false WARN/h | false ERROR/h | cannot tell "
    "|\n"
    "|---|---|---|---|---|---|---|---|---|\n";

void printRoads() {
  std::printf("| road | %s", kHead);
  for (const char* iso_class : {"A", "B", "C", "D"})
    for (const double speed : {3.0, 10.0, 30.0})
      for (const Change& change : kChanges) {
        const std::string name = std::string("ISO ") + iso_class + ", " + std::to_string(std::lround(speed)) + " m/s";
        printRow(name.c_str(), change, judgeAll({iso_class, speed}, change, 1.0));
      }
}

void printPayloads() {
  std::printf("\n| payload, ISO C, 10 m/s | %s", kHead);
  for (const double mass : {0.7, 1.3})
    for (const Change& change : kChanges)
      printRow(mass < 1.0 ? "-30 %" : "+30 %", change, judgeAll({"C", 10.0}, change, mass));
}

struct Spread {
  double sum = 0.0, least = std::numeric_limits<double>::infinity(), most = -least;
  void add(double value) {
    sum += value;
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

// The paper's ramp: -15 % at 67 s, -30 % at 94 s.
void printRamps() {
  constexpr int kRampSeeds = 60;
  constexpr double kWarnDue = 67.0, kErrorDue = 94.0;
  std::printf(
      "| scenario | WARN [s]: mean, least, most | ERROR [s]: mean, least, most | early notice at [s] | "
      "WARN later than 5 s |\n|---|---|---|---|---|\n");
  for (const char* scenario : {"paper_clean", "paper_outliers"}) {
    Spread warns, errors, notices;
    int late = 0;
    for (int seed = 1; seed <= kRampSeeds; ++seed) {
      SimulationOptions options;
      options.scenario = scenario;
      options.seed = seed;
      const FirstAlarms first = firstAlarms(simulate(options), optionsFor(0.02, kPaperB1, kPaperB0));
      const double never = std::numeric_limits<double>::infinity();
      warns.add(first.warn.value_or(never) - kWarnDue);
      errors.add(first.error.value_or(never) - kErrorDue);
      notices.add(first.early.value_or(never));
      late += first.warn.value_or(never) > kWarnDue + 5.0 ? 1 : 0;
    }
    std::printf("| %s | %.1f, %.1f, %.1f | %.1f, %.1f, %.1f | %.0f | %d of %d |\n", scenario, warns.sum / kRampSeeds,
                warns.least, warns.most, errors.sum / kRampSeeds, errors.least, errors.most, notices.sum / kRampSeeds,
                late, kRampSeeds);
  }
}

template <class Noise>
void printDay(double hours, const char* kind, unsigned seed, const Noise& noise) {
  const DayCounts day = healthyDay(optionsFor(0.02, kPaperB1, kPaperB0), hours, seed, noise);
  std::printf("| %s | %u | %ld | %ld | %ld | %.1f %% |\n", kind, seed, day.error, day.warn, day.early,
              100.0 * static_cast<double>(day.stale) / static_cast<double>(day.samples));
  std::fflush(stdout);
}

void printDays() {
  constexpr double kHours = 24.0, kNoise = 0.024;
  std::printf("\n| noise | seed | ERROR | WARN | early notices | cannot tell |\n|---|---|---|---|---|---|\n");
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const double half_width = kNoise * std::sqrt(3.0);
    printDay(kHours, "uniform", seed, std::uniform_real_distribution<double>(-half_width, half_width));
    printDay(kHours, "normal", seed, std::normal_distribution<double>(0.0, kNoise));
  }
  std::printf("\n");
}

}  // namespace
}  // namespace suspension_health_monitor

int main() {
  using namespace suspension_health_monitor;
  printRamps();
  printDays();
  printPayloads();
  std::printf("\n");
  printRoads();
}
