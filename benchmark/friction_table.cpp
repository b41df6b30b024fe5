// Prints the table of dampers that are not linear of doc/health.md: a baseline that is learned on one road, then the
// same strut, or one that has lost 40 % of its damping, on another.
//   tables friction [SEED]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

#include "field_monitor.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLearned = 120.0, kJudged = 300.0;  // [s]

/// From one road to another, by their letters.
struct Way {
  const char* name;
  double from, to;  // Gd(0.1) [m^3]
};

constexpr std::array kWays{Way{"A to C", 16e-6, 256e-6}, Way{"B to D", 64e-6, 1024e-6}, Way{"C to A", 256e-6, 16e-6}};

/// What a strut has beside the linear one.
struct Damper {
  const char* name;
  double friction, digressive;  // as in FieldDrive
};

constexpr std::array kDampers{Damper{"linear", 0.0, 0.0},
                              Damper{"friction 0.05 m/s^2", 0.05, 0.0},
                              Damper{"friction 0.1 m/s^2", 0.1, 0.0},
                              Damper{"friction 0.2 m/s^2", 0.2, 0.0},
                              Damper{"friction 0.4 m/s^2", 0.4, 0.0},
                              Damper{"digressive, 0.8 m/s", 0.0, 0.8},
                              Damper{"digressive, 0.3 m/s", 0.0, 0.3}};

/// What was said on the second road, of all vehicles.
struct Judged {
  std::array<double, 4> samples{};  // by level
  std::vector<double> damping;      // its median change, of each vehicle that has a baseline
  std::vector<double> heard;        // the friction in that baseline
  int not_learned = 0;

  long percent(HealthLevel level) const {
    const double all = std::accumulate(samples.begin(), samples.end(), 0.0);
    return std::lround(100.0 * samples[static_cast<std::size_t>(level)] / all);
  }
};

void judge(const FieldDrive& drive, Judged& judged) {
  MonitorOptions options;
  options.sample_period = 1.0 / drive.rate;
  SuspensionMonitor monitor(options);
  FieldSimulator simulator(drive);
  while (simulator.time() < drive.change_at) monitor.addSample(simulator.next());
  if (!monitor.baseline().learned) return void(++judged.not_learned);
  judged.heard.push_back(monitor.baseline().friction->force);
  std::vector<double> damping;
  while (simulator.time() < drive.change_at + kJudged) {
    const MonitorReport* report = monitor.addSample(simulator.next());
    if (report == nullptr) continue;
    judged.samples[static_cast<std::size_t>(report->health.level)] += 1.0;
    if (report->health.damping_change) damping.push_back(*report->health.damping_change);
  }
  judged.damping.push_back(median(std::move(damping)));
}

void printRow(const Damper& damper, const Way& way, double left, const Judged& judged) {
  const auto range = [](std::vector<double> values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return std::pair(*least, *most);
  };
  std::printf("| %s | %s | %+.0f %% | ", damper.name, way.name, 100.0 * (left - 1.0));
  if (judged.heard.empty()) return void(std::printf("none learned | | | | | |\n"));
  const auto heard = range(judged.heard), damping = range(judged.damping);
  std::printf("%.2f to %.2f | %+.0f to %+.0f %% | %ld | %ld | %ld | %ld | %d |\n", heard.first, heard.second,
              100.0 * damping.first, 100.0 * damping.second, judged.percent(HealthLevel::kOk),
              judged.percent(HealthLevel::kWarn), judged.percent(HealthLevel::kError),
              judged.percent(HealthLevel::kStale), judged.not_learned);
  std::fflush(stdout);
}

Judged judge(const Damper& damper, const Way& way, double left, unsigned seed) {
  Judged judged;
  for (const FieldVehicle& vehicle : kFieldVehicles) {
    FieldDrive drive;
    drive.vehicle = vehicle;
    drive.friction = damper.friction;
    drive.digressive = damper.digressive;
    drive.rate = 100;
    drive.road = way.from;
    drive.change_at = kLearned;
    drive.road_after = way.to;
    drive.damping_left = left;
    drive.seed = seed;
    judge(drive, judged);
  }
  return judged;
}

void printTable(unsigned seed) {
  std::printf(
      "| damper | roads | damping is | friction heard [m/s^2] | damping judged | OK %% | WARN %% | ERROR %% | STALE %% "
      "| "
      "no baseline |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Damper& damper : kDampers)
    for (const Way& way : kWays)
      for (const double left : {1.0, 0.6}) printRow(damper, way, left, judge(damper, way, left, seed));
}

int command(const Arguments& arguments) { return printTable(arguments.seed(0)), 0; }

const AddTable kAdded("friction", {"[SEED]", command});

}  // namespace
}  // namespace suspension_health_monitor
