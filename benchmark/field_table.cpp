// Prints the tables that doc/robustness.md quotes: what is said of a strut as it is met there.
//   tables field healthy|unfiltered|steps [MEMORY [HOURS]]     memory in seconds; hours of a drive, default 10;
//   unfiltered: healthy without an anti-alias filter
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "field_monitor.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

bool isRaised(HealthLevel level) { return level == HealthLevel::kWarn || level == HealthLevel::kError; }

struct Counts {
  int warn = 0, error = 0, early = 0, sensor = 0;
  double stale = 0.0, outliers = 0.0, samples = 0.0;
  std::string words;  // of the first alarm
};

Counts count(const FieldDrive& drive, std::optional<double> memory, double seconds) {
  Counts counts;
  HealthReport before;
  follow(drive, memory, seconds, [&](double, const MonitorReport& report) {
    const HealthReport& now = report.health;
    if (now.level != before.level && isRaised(now.level)) {
      ++(now.level == HealthLevel::kWarn ? counts.warn : counts.error);
      if (counts.words.empty()) counts.words = describe(now);
    }
    counts.early += int{now.early_warning && !before.early_warning};
    counts.sensor += int{now.sensor.fault != SensorFault::kNone && before.sensor.fault == SensorFault::kNone};
    counts.stale += now.level == HealthLevel::kStale ? 1.0 : 0.0;
    counts.outliers += now.outliers ? 1.0 : 0.0;
    counts.samples += 1.0;
    before = now;
  });
  return counts;
}

struct Healthy {
  std::string name;
  FieldDrive drive;
};

std::vector<Healthy> healthyDrives(bool anti_aliased) {
  struct Condition {
    const char* name;
    std::function<void(FieldDrive&)> set;
  };
  const std::vector<Condition> conditions{
      {"plain", [](FieldDrive&) {}},
      {"payload +15 %", [](FieldDrive& drive) { drive.mass = 1.15; }},
      {"payload +30 %", [](FieldDrive& drive) { drive.mass = 1.3; }},
      {"payload -15 %", [](FieldDrive& drive) { drive.mass = 0.85; }},
      {"payload -30 %", [](FieldDrive& drive) { drive.mass = 0.7; }},
      {"potholes, washboard", [](FieldDrive& drive) { drive.potholes = drive.washboard = true; }},
      {"stop and go", [](FieldDrive& drive) { drive.stops = true; }},
      {"stop and go, tilt 2 deg",
       [](FieldDrive& drive) {
         drive.stops = true;
         drive.tilt = 2.0 * M_PI / 180.0;
       }},
      {"engine 0.5 m/s^2", [](FieldDrive& drive) { drive.engine = 0.5; }},
      {"engine 1.5 m/s^2", [](FieldDrive& drive) { drive.engine = 1.5; }},
      {"fade 5 %", [](FieldDrive& drive) { drive.fade = 0.05; }},
      {"offset +- 0.3 m/s^2", [](FieldDrive& drive) { drive.offset_swing = 0.3; }},
  };
  std::vector<Healthy> drives;
  for (const FieldWay& way :
       {FieldWay{"A, 30 m/s, 100 Hz", 16e-6, 30.0, 100}, FieldWay{"C, 15 m/s, 200 Hz", 256e-6, 15.0, 200},
        FieldWay{"E, 3 m/s, 100 Hz", 4096e-6, 3.0, 100}, FieldWay{"B, 20 m/s, 500 Hz", 64e-6, 20.0, 500},
        FieldWay{"A, 3 m/s, 200 Hz", 16e-6, 3.0, 200}})
    for (const Condition& condition : conditions) {
      FieldDrive drive;
      drive.vehicle = kFieldVehicles[drives.size() % kFieldVehicles.size()];
      drive.road = way.road;
      drive.speed = way.speed;
      drive.rate = way.rate;
      drive.offset = 0.3;
      drive.anti_aliased = anti_aliased;
      drive.seed = 100 + static_cast<unsigned>(drives.size());
      condition.set(drive);
      drives.push_back({std::string(way.name) + " | " + condition.name, drive});
    }
  return drives;
}

void printHealthy(std::optional<double> memory, double hours, bool anti_aliased) {
  std::printf(
      "| road, %.0f h | what | vehicle | WARN | ERROR | early notices | outliers | cannot tell | sensor accused "
      "| said first |\n|---|---|---|---|---|---|---|---|---|---|\n",
      hours);
  const std::vector<Healthy> drives = healthyDrives(anti_aliased);
  const auto start = [&](std::size_t i) {
    return std::async(std::launch::async, count, drives[i].drive, memory, 3600.0 * hours);
  };
  std::future<Counts> next = start(0);
  for (std::size_t i = 0; i < drives.size(); ++i) {  // two at a time
    std::future<Counts> present = std::move(next);
    if (i + 1 < drives.size()) next = start(i + 1);
    const Counts found = present.get();
    std::printf("| %s | %s | %d | %d | %d | %.1f %% | %.1f %% | %d | %s |\n", drives[i].name.c_str(),
                drives[i].drive.vehicle.name, found.warn, found.error, found.early,
                100.0 * found.outliers / found.samples, 100.0 * found.stale / found.samples, found.sensor,
                found.words.c_str());
    std::fflush(stdout);
  }
}

constexpr double kStepAt = 120.0, kStepDrive = 300.0;  // [s]
constexpr std::size_t kStepDrives = 8;

FieldDrive stepDrive(std::size_t i) {
  constexpr std::array kRoads{16e-6, 64e-6, 256e-6, 1024e-6};
  constexpr std::array kSpeeds{10.0, 20.0, 15.0, 5.0};
  constexpr std::array kRates{200, 500, 200, 100};
  FieldDrive drive;
  drive.vehicle = kFieldVehicles[i % 4];
  drive.road = kRoads[i / 2 % 4];
  drive.speed = kSpeeds[(i + i / 4) % 4];
  drive.rate = kRates[i % 4];
  drive.offset = 0.2;
  drive.change_at = kStepAt;
  drive.seed = 900 + static_cast<unsigned>(i);
  return drive;
}

std::string foundAndMedian(std::vector<double> delays) {
  std::sort(delays.begin(), delays.end());
  const auto found = std::count_if(delays.begin(), delays.end(), [](double delay) { return delay < kNever; });
  const double median = 0.5 * (delays[kStepDrives / 2 - 1] + delays[kStepDrives / 2]);
  std::string text = std::to_string(found);
  if (std::isfinite(median)) text += ", " + std::to_string(std::lround(median)) + " s";
  return text;
}

void printSteps(std::optional<double> memory) {
  struct Step {
    const char* name;
    double damping, stiffness;
  };
  std::printf(
      "| step | body mass | before it | WARN: found of 8, median after | ERROR | right part |\n"
      "|---|---|---|---|---|---|\n");
  for (const double mass : {1.0, 1.3, 0.7})
    for (const Step& step :
         {Step{"damping -20 %", 0.8, 1.0}, Step{"damping -31 %", 0.69, 1.0}, Step{"damping -50 %", 0.5, 1.0},
          Step{"stiffness -20 %", 1.0, 0.8}, Step{"stiffness -31 %", 1.0, 0.69}}) {
      std::vector<double> warn, error;
      int before = 0, right = 0;
      for (std::size_t i = 0; i < kStepDrives; ++i) {
        FieldDrive drive = stepDrive(i);
        drive.mass = mass;
        drive.damping_left = step.damping;
        drive.stiffness_left = step.stiffness;
        double first_warn = kNever, first_error = kNever;
        HealthReport last;
        follow(drive, memory, kStepDrive, [&](double time, const MonitorReport& report) {
          const bool changes = report.health.level != last.level;
          last = report.health;
          if (!isRaised(last.level)) return;
          before += int{time < kStepAt && changes};
          first_warn = std::min(first_warn, time - kStepAt);
          if (last.level == HealthLevel::kError) first_error = std::min(first_error, time - kStepAt);
        });
        warn.push_back(first_warn);
        error.push_back(first_error);
        const bool damper = isRaised(last.damping_level), spring = isRaised(last.stiffness_level);
        right += int{step.damping < 1.0 ? damper && !spring : spring && !damper};
      }
      std::printf("| %s | %+.0f %% | %d | %s | %s | %d |\n", step.name, 100.0 * (mass - 1.0), before,
                  foundAndMedian(warn).c_str(), foundAndMedian(error).c_str(), right);
      std::fflush(stdout);
    }
}

int command(const Arguments& arguments) {
  const std::string what = arguments.word(0);
  const std::optional<double> memory = arguments.given(1);
  if (what == "healthy" || what == "unfiltered")
    printHealthy(memory, arguments.number(2, 10.0), what == "healthy");
  else if (what == "steps")
    printSteps(memory);
  else
    return 2;
  return 0;
}

const AddTable kAdded("field", {"healthy|unfiltered|steps [MEMORY [HOURS]]", command});

}  // namespace
}  // namespace suspension_health_monitor
