// Estimates from sensors as they really come against those from ideal ones, and what bringing them onto one grid costs.
//   alignment_table                           the table of doc/alignment.md
//   alignment_table --loop ALIGNMENT RATE COUNT   COUNT readings of 200 Hz and as long a stream of RATE Hz, paired or
//                                             resampled onto 200 Hz, for counting instructions
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "suspension_health_monitor/signal/uniform_grid.h"
#include "suspension_health_monitor/simulation/drive_simulator.h"
#include "suspension_health_monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.005;

struct Means {
  double damping = 0.0, stiffness = 0.0, valid = 0.0, count = 0.0;
};

/// LA's estimates, over the drive from 20 s on.
Means identify(const SimulationOptions& drive, Alignment alignment) {
  MonitorOptions options;
  options.sample_period = kPeriod;
  options.forgetting_factor = 0.999;
  SuspensionMonitor monitor(options);
  UniformGrid grid(kPeriod, {alignment, false, 2 * monitor.horizonSamples()});
  DriveSimulator simulator(drive);
  Means sum;
  const auto push = [&](Side side, const std::optional<AccelerometerReading>& reading) {
    if (!reading) return;
    for (auto sample = grid.push(side, reading->stamp, reading->acceleration); sample; sample = grid.next()) {
      const MonitorReport* report = monitor.addSample(*sample);
      if (report == nullptr || toSeconds(sample->stamp) < 20.0) continue;
      sum.damping += report->la.damping_to_mass;
      sum.stiffness += report->la.stiffness_to_mass;
      sum.valid += report->la.valid ? 1.0 : 0.0;
      sum.count += 1.0;
    }
  };
  while (const auto sample = simulator.next()) {
    push(Side::kSprung, sample->sprung);
    push(Side::kUnsprung, sample->unsprung);
  }
  return {sum.damping / sum.count, sum.stiffness / sum.count, sum.valid / sum.count, sum.count};
}

void print(const char* name, const Means& real, const Means& ideal) {
  std::printf("| %s | %+.2f | %+.2f | %.0f |\n", name, 100.0 * (real.damping / ideal.damping - 1.0),
              100.0 * (real.stiffness / ideal.stiffness - 1.0), 100.0 * real.valid);
}

void printTable() {
  for (const char* scenario : {"paper_clean", "iso_road"}) {
    SimulationOptions drive;
    drive.scenario = scenario;
    drive.duration = 60.0;
    drive.rate = 1.0 / kPeriod;
    const Means ideal = identify(drive, Alignment::kPaired);
    std::printf("\n| %s | b1 [%%] | b0 [%%] | valid [%%] |\n|---|---|---|---|\n", scenario);
    print("200 Hz both, in step, resampled", identify(drive, Alignment::kResampled), ideal);
    drive.unsprung_rate = 333.0;
    drive.unsprung_phase = 0.0011;
    print("200 and 333 Hz", identify(drive, Alignment::kAuto), ideal);
    drive.dropout = 0.02;
    print("... and 2 % lost", identify(drive, Alignment::kAuto), ideal);
    drive.sampling_jitter = 0.001;
    print("... and taken up to 1 ms late", identify(drive, Alignment::kAuto), ideal);
    print("the same, paired", identify(drive, Alignment::kPaired), ideal);
    drive.stamp_jitter = 0.001;
    print("... and stamped up to 1 ms late besides", identify(drive, Alignment::kAuto), ideal);
    drive.sampling_jitter = 0.0;
    print("stamped late only", identify(drive, Alignment::kAuto), ideal);
  }
}

int loop(std::string_view alignment_name, double rate, long count) {
  UniformGrid grid(kPeriod, {alignment(alignment_name), false, 240});
  double sum = 0.0;
  const auto push = [&](Side side, long k, double spacing) {
    const Stamp stamp = fromSeconds(static_cast<double>(k) * spacing);
    for (auto sample = grid.push(side, stamp, static_cast<double>(k % 7)); sample; sample = grid.next())
      sum += sample->sprung_acceleration;
  };
  long wheel = 0;
  for (long k = 0; k < count; ++k) {
    push(Side::kSprung, k, kPeriod);
    for (; static_cast<double>(wheel) <= static_cast<double>(k) * kPeriod * rate; ++wheel)
      push(Side::kUnsprung, wheel, 1.0 / rate);
  }
  return sum == 0.0 ? EXIT_FAILURE : EXIT_SUCCESS;
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  if (argc == 5 && std::string_view(argv[1]) == "--loop") return loop(argv[2], std::atof(argv[3]), std::atol(argv[4]));
  printTable();
}
