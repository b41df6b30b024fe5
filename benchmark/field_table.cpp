// Prints the tables of doc/field.md: what health says of a strut in the field, over hours, and how soon it finds a
// change. Usage: field_table healthy|steps|accuracy [MEMORY_SECONDS [HOURS]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "field_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

double memory = 2.0, hours = 10.0;

MonitorSettings settingsFor(const FieldDrive& drive) {
  MonitorOptions options;
  options.sample_period = 1.0 / drive.rate;
  options.forgetting_factor = 1.0 - 1.0 / (drive.rate * memory);
  options.nominal_damping_to_mass = drive.vehicle.b1;
  options.nominal_stiffness_to_mass = drive.vehicle.b0;
  return MonitorSettings(options);
}

struct Counts {
  int warn = 0, error = 0, early = 0, outlier_events = 0, sensor = 0;
  double stale = 0, outliers = 0, samples = 0;
  std::vector<std::string> words;
};

Counts count(const FieldDrive& drive, double seconds) {
  FieldSimulator simulator(drive);
  SuspensionMonitor monitor(settingsFor(drive));
  Counts counts;
  HealthReport before;
  while (simulator.time() < seconds) {
    const MonitorReport* report = monitor.addSample(simulator.next());
    if (report == nullptr) continue;
    const HealthReport& now = report->health;
    const bool rises =
        now.level != before.level && (now.level == HealthLevel::kWarn || now.level == HealthLevel::kError);
    counts.warn += rises && now.level == HealthLevel::kWarn;
    counts.error += rises && now.level == HealthLevel::kError;
    if (rises && counts.words.size() < 3) counts.words.push_back(describe(now));
    counts.early += now.early_warning && !before.early_warning;
    counts.outlier_events += now.outliers && !before.outliers;
    counts.sensor += now.sensor.fault != SensorFault::kNone && before.sensor.fault == SensorFault::kNone;
    counts.stale += now.level == HealthLevel::kStale;
    counts.outliers += now.outliers;
    ++counts.samples;
    before = now;
  }
  return counts;
}

struct Case {
  std::string name;
  FieldDrive drive;
};

std::vector<Case> healthyCases() {
  std::vector<Case> cases;
  int seed = 100;
  const auto add = [&](const std::string& name, double road, double speed, int rate, auto change) {
    FieldDrive drive;
    drive.vehicle = kFieldVehicles[seed % 4];
    drive.road = road;
    drive.speed = speed;
    drive.rate = rate;
    drive.offset = 0.3;
    drive.seed = static_cast<unsigned>(seed++);
    change(drive);
    cases.push_back({name, drive});
  };
  struct Way {
    const char* name;
    double road, speed;
    int rate;
  };
  const std::vector<Way> ways{{"A 30 m/s, 100 Hz", 16e-6, 30.0, 100},
                              {"C 15 m/s, 200 Hz", 256e-6, 15.0, 200},
                              {"E 3 m/s, 100 Hz", 4096e-6, 3.0, 100},
                              {"B 20 m/s, 500 Hz", 64e-6, 20.0, 500},
                              {"A 3 m/s, 200 Hz", 16e-6, 3.0, 200}};
  for (const Way& way : ways) {
    const auto with = [&](const char* what, auto change) {
      add(std::string(what) + ", " + way.name, way.road, way.speed, way.rate, change);
    };
    with("plain", [](FieldDrive&) {});
    with("payload +15 %", [](FieldDrive& d) { d.mass = 1.15; });
    with("payload +30 %", [](FieldDrive& d) { d.mass = 1.3; });
    with("payload -15 %", [](FieldDrive& d) { d.mass = 0.85; });
    with("payload -30 %", [](FieldDrive& d) { d.mass = 0.7; });
    with("potholes, washboard", [](FieldDrive& d) { d.potholes = d.washboard = true; });
    with("stop and go", [](FieldDrive& d) { d.stops = true; });
    with("engine 0.5", [](FieldDrive& d) { d.engine = 0.5; });
    with("engine 1.5", [](FieldDrive& d) { d.engine = 1.5; });
    with("fade 5 %", [](FieldDrive& d) { d.fade = 0.05; });
    with("offset drifts 0.3", [](FieldDrive& d) { d.offset_swing = 0.3; });
  }
  return cases;
}

void printHealthy() {
  const std::vector<Case> cases = healthyCases();
  std::printf(
      "| drive, %.0f h, memory %.1f s | vehicle | WARN | ERROR | early | outlier flag | cannot tell | sensor | words "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|\n",
      hours, memory);
  for (std::size_t i = 0; i < cases.size(); i += 2) {
    Counts counts[2];
    std::thread other([&] {
      if (i + 1 < cases.size()) counts[1] = count(cases[i + 1].drive, 3600.0 * hours);
    });
    counts[0] = count(cases[i].drive, 3600.0 * hours);
    other.join();
    for (std::size_t j = i; j < std::min(i + 2, cases.size()); ++j) {
      const Counts& c = counts[j - i];
      std::string words;
      for (const std::string& word : c.words) words += word + "; ";
      std::printf("| %s | %s | %d | %d | %d | %.1f %%, %d | %.1f %% | %d | %s |\n", cases[j].name.c_str(),
                  cases[j].drive.vehicle.name, c.warn, c.error, c.early, 100 * c.outliers / c.samples, c.outlier_events,
                  100 * c.stale / c.samples, c.sensor, words.c_str());
    }
    std::fflush(stdout);
  }
}

void printSteps() {
  std::printf(
      "| step at 120 s, memory %.1f s | payload | false before | WARN [s]: found, median, most | ERROR: found, median, "
      "most | right part |\n"
      "|---|---|---|---|---|---|\n",
      memory);
  struct Step {
    const char* name;
    double damping, stiffness;
  };
  for (const double mass : {1.0, 1.3, 0.7})
    for (const Step& step : {Step{"damping -20 %", 0.8, 1.0},
                             {"damping -30 %", 0.69, 1.0},
                             {"damping -50 %", 0.5, 1.0},
                             {"stiffness -20 %", 1.0, 0.8},
                             {"stiffness -30 %", 1.0, 0.69},
                             {"both -30 %", 0.7, 0.7}}) {
      std::vector<double> warn, error;
      int early = 0, right = 0;
      std::string words;
      for (int i = 0; i < 8; ++i) {
        FieldDrive drive;
        drive.vehicle = kFieldVehicles[i % 4];
        drive.road = std::array{16e-6, 64e-6, 256e-6, 1024e-6}[(i / 2) % 4];
        drive.speed = std::array{10.0, 20.0, 15.0, 5.0}[(i + i / 4) % 4];
        drive.rate = std::array{100, 200, 500, 200}[(i + 1) % 4];
        drive.offset = 0.2;
        drive.mass = mass;
        drive.change_at = 120.0;
        drive.damping_left = step.damping;
        drive.stiffness_left = step.stiffness;
        drive.seed = 900 + static_cast<unsigned>(i);
        FieldSimulator simulator(drive);
        SuspensionMonitor monitor(settingsFor(drive));
        double first_warn = 1e9, first_error = 1e9;
        HealthReport last;
        while (simulator.time() < 300.0) {
          const MonitorReport* report = monitor.addSample(simulator.next());
          if (report == nullptr) continue;
          last = report->health;
          const bool raised = last.level == HealthLevel::kWarn || last.level == HealthLevel::kError;
          if (raised && simulator.time() < 120.0) ++early;
          if (raised) first_warn = std::min(first_warn, simulator.time() - 120.0);
          if (last.level == HealthLevel::kError) first_error = std::min(first_error, simulator.time() - 120.0);
        }
        warn.push_back(first_warn);
        error.push_back(first_error);
        const bool of_damping = step.damping < 1.0;
        const auto raised = [](HealthLevel level) {
          return level == HealthLevel::kWarn || level == HealthLevel::kError;
        };
        right += raised(of_damping ? last.damping_level : last.stiffness_level) &&
                 !raised(of_damping ? last.stiffness_level : last.damping_level);
        if (i < 2) words += describe(last) + "; ";
      }
      const auto text = [](std::vector<double>& delays) {
        std::sort(delays.begin(), delays.end());
        const auto found = std::count_if(delays.begin(), delays.end(), [](double d) { return d < 1e8; });
        char line[64];
        std::snprintf(line, sizeof line, "%ld, %.1f, %.1f", static_cast<long>(found), delays[3],
                      delays[found > 0 ? found - 1 : 0]);
        return std::string(line);
      };
      std::printf("| %s | %+.0f %% | %d | %s | %s | %d of 8 | %s |\n", step.name, 100 * (mass - 1), early,
                  text(warn).c_str(), text(error).c_str(), right, words.c_str());
      std::fflush(stdout);
    }
}

void printAccuracy() {
  std::printf(
      "| road, rate | vehicle | offset | b1 LS, LA off by [%%] (median) | b0 LS, LA | inside 95 %%: b1 LS, b0 LS, b1 "
      "LA, b0 LA |\n|---|---|---|---|---|---|\n");
  struct Offset {
    double constant, swing;
  };
  unsigned seed = 1;
  for (const double road : {16e-6, 256e-6})
    for (const int rate : {50, 100, 200, 500})
      for (const FieldVehicle& vehicle : kFieldVehicles)
        for (const Offset& offset : {Offset{0.0, 0.0}, {0.05, 0.0}, {0.3, 0.0}, {0.8, 0.0}, {0.0, 0.3}}) {
          FieldDrive drive;
          drive.vehicle = vehicle;
          drive.road = road;
          drive.rate = rate;
          drive.offset = offset.constant;
          drive.offset_swing = offset.swing;
          drive.seed = seed++;
          FieldSimulator simulator(drive);
          SuspensionMonitor monitor(settingsFor(drive));
          std::vector<double> errors[4];
          double inside[4] = {}, valid = 0, samples = 0;
          int next = 20;
          while (simulator.time() < 600.0) {
            const MonitorReport* report = monitor.addSample(simulator.next());
            if (report == nullptr || simulator.time() < next) continue;
            next += 2;
            ++samples;
            if (!report->la.valid() || !report->ls.valid()) continue;
            ++valid;
            const auto take = [&](int i, double value, double stddev, double truth) {
              errors[i].push_back(value / truth - 1);
              inside[i] += std::abs(value - truth) < 1.96 * stddev;
            };
            take(0, report->ls.damping_to_mass, report->ls.damping_to_mass_stddev, vehicle.b1);
            take(1, report->ls.stiffness_to_mass, report->ls.stiffness_to_mass_stddev, vehicle.b0);
            take(2, report->la.damping_to_mass, report->la.damping_to_mass_stddev, vehicle.b1);
            take(3, report->la.stiffness_to_mass, report->la.stiffness_to_mass_stddev, vehicle.b0);
          }
          const auto median = [](std::vector<double>& v) {
            if (v.empty()) return std::nan("");
            std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
            return 100 * v[v.size() / 2];
          };
          std::printf(
              "| %s %d Hz | %s | %.2f +- %.1f | %.1f, %.1f | %.1f, %.1f | %.0f, %.0f, %.0f, %.0f (valid %.0f %%)|\n",
              road < 2e-5 ? "A" : "C", rate, vehicle.name, offset.constant, offset.swing, median(errors[0]),
              median(errors[2]), median(errors[1]), median(errors[3]), 100 * inside[0] / valid, 100 * inside[1] / valid,
              100 * inside[2] / valid, 100 * inside[3] / valid, 100 * valid / samples);
        }
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  const std::string what = argc > 1 ? argv[1] : "";
  if (argc > 2) memory = std::atof(argv[2]);
  if (argc > 3) hours = std::atof(argv[3]);
  if (what == "healthy")
    printHealthy();
  else if (what == "steps")
    printSteps();
  else if (what == "accuracy")
    printAccuracy();
  else
    return std::fprintf(stderr, "usage: field_table healthy|steps|accuracy [MEMORY_SECONDS [HOURS]]\n"), 2;
}
