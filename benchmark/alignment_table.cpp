// Estimates from sensors as they really come against those from ideal ones, and what bringing them onto one grid costs.
//   alignment_table                           the table of doc/alignment.md
//   alignment_table --loop ALIGNMENT RATE COUNT   COUNT readings of 200 Hz and as long a stream of RATE Hz, paired or
//                                             resampled onto 200 Hz, for counting instructions
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "../test/core/mean_estimates.h"
#include "suspension_health_monitor/internal/signal/uniform_grid.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {
namespace {

void print(const char* name, const MeanEstimates& real, const MeanEstimates& ideal) {
  std::printf("| %s | %+.2f | %+.2f | %.0f |\n", name, 100.0 * (real.la_damping / ideal.la_damping - 1.0),
              100.0 * (real.la_stiffness / ideal.la_stiffness - 1.0), 100.0 * real.valid);
}

void printTable() {
  for (const char* scenario : {"paper_clean", "iso_road"}) {
    SimulationOptions drive;
    drive.scenario = scenario;
    drive.duration = 60.0;
    drive.rate = 1.0 / kAlignedPeriod;
    const MeanEstimates ideal = identify(drive, Alignment::kPaired);
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
  UniformGrid grid(kAlignedPeriod, {alignment(alignment_name), false, 240});
  double sum = 0.0;
  const auto push = [&](Side side, long k, double spacing) {
    const Stamp stamp = fromSeconds(static_cast<double>(k) * spacing);
    for (auto sample = grid.push(side, stamp, static_cast<double>(k % 7)); sample; sample = grid.next())
      sum += sample->sprung_acceleration;
  };
  long wheel = 0;
  for (long k = 0; k < count; ++k) {
    push(Side::kSprung, k, kAlignedPeriod);
    for (; static_cast<double>(wheel) <= static_cast<double>(k) * kAlignedPeriod * rate; ++wheel)
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
