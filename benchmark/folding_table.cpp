// What IMUs without an anti-alias filter cost, and a noisy one on the wheel: the table of doc/robustness.md. Healthy
// quarter cars of field_drive.h.
//   folding_table [SECONDS]     of a drive, default 200
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "field_monitor.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr FieldWay kWays[] = {{"A, 30 m/s, 100 Hz", 16e-6, 30.0, 100}, {"C, 15 m/s, 100 Hz", 256e-6, 15.0, 100},
                              {"D, 8 m/s, 100 Hz", 1024e-6, 8.0, 100}, {"E, 3 m/s, 100 Hz", 4096e-6, 3.0, 100},
                              {"C, 15 m/s, 50 Hz", 256e-6, 15.0, 50},  {"A, 30 m/s, 200 Hz", 16e-6, 30.0, 200},
                              {"C, 15 m/s, 200 Hz", 256e-6, 15.0, 200}};
constexpr double kSettled = 30.0;  // [s]

struct Readings {
  const char* name;
  bool anti_aliased;
  double wheel_noise;
};

constexpr Readings kReadings[] = {
    {"filtered", true, 1.0}, {"unfiltered", false, 1.0}, {"filtered, noisy wheel", true, 10.0}};

void printRow(const FieldWay& way, const FieldVehicle& vehicle, const Readings& readings, double seconds) {
  FieldDrive drive;
  drive.vehicle = vehicle;
  drive.road = way.road;
  drive.speed = way.speed;
  drive.rate = way.rate;
  drive.anti_aliased = readings.anti_aliased;
  drive.wheel_noise = readings.wheel_noise;
  FieldSimulator simulator(drive);
  SuspensionMonitor monitor(settingsFor(drive));
  std::vector<double> stiffness, stddev, folded;
  double samples = 0.0, valid = 0.0, wrong = 0.0, alarm = 0.0;
  while (simulator.time() < seconds) {
    const MonitorReport* report = monitor.addSample(simulator.next());
    if (report == nullptr || simulator.time() < kSettled) continue;
    const StrutEstimate& la = report->la;
    samples += 1.0;
    stiffness.push_back(la.stiffness_to_mass / vehicle.b0 - 1.0);
    folded.push_back(monitor.input().folded[1]);
    if (report->health.level == HealthLevel::kWarn || report->health.level == HealthLevel::kError) alarm += 1.0;
    if (!la.valid()) continue;
    valid += 1.0;
    stddev.push_back(la.stiffness_to_mass_stddev / vehicle.b0);
    wrong += std::abs(la.stiffness_to_mass - vehicle.b0) > 3.0 * la.stiffness_to_mass_stddev ? 1.0 : 0.0;
  }
  char shown_stddev[20] = "-";
  if (!stddev.empty()) std::snprintf(shown_stddev, sizeof shown_stddev, "%.1f %%", 100.0 * median(stddev));
  std::printf("| %s | %s | %s | %.2f | %+.1f %% | %s | %.0f %% | %.0f %% | %.0f %% |\n", way.name, vehicle.name,
              readings.name, median(folded), 100.0 * median(stiffness), shown_stddev, 100.0 * valid / samples,
              100.0 * wrong / samples, 100.0 * alarm / samples);
  std::fflush(stdout);
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  const double seconds = argc > 1 ? std::atof(argv[1]) : 200.0;
  std::printf(
      "| road, rate | vehicle | readings | folded, at most [m/s^2] | b0 of LA | its stddev while valid | valid | "
      "beyond 3 stddev | WARN, ERROR |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const FieldWay& way : kWays)
    for (const FieldVehicle& vehicle : kFieldVehicles)
      for (const Readings& readings : kReadings) printRow(way, vehicle, readings, seconds);
}
