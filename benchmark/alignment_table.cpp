// Estimates from sensors as they really come against those from ideal ones, and what bringing them onto one grid costs.
//   alignment_table [SEEDS]                   the table; measurements of each drive, default 20
//   alignment_table --loop ALIGNMENT RATE COUNT   COUNT readings of 200 Hz and as long a stream of RATE Hz, paired or
//                                             resampled onto 200 Hz, for counting instructions
#include <Eigen/Core>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "../test/core/mean_estimates.h"
#include "../test/core/uniform_grid.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {
namespace {

/// A line: mean and its standard error over the measurements.
void print(const char* name, int seeds, const SimulationOptions& sensors, Alignment alignment) {
  Eigen::ArrayXXd off(seeds, 2);
  double valid = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    SimulationOptions real = sensors, ideal;
    real.seed = ideal.seed = seed + 1;
    ideal.scenario = sensors.scenario;
    ideal.duration = sensors.duration;
    ideal.rate = sensors.rate;
    const MeanEstimates found = identify(real, alignment), reference = identify(ideal, Alignment::kPaired);
    off.row(seed) << found.damping / reference.damping - 1.0, found.stiffness / reference.stiffness - 1.0;
    valid += found.valid / seeds;
  }
  off *= 100.0;
  const Eigen::Array2d mean = off.colwise().mean();
  const Eigen::Array2d error =
      ((off.rowwise() - mean.transpose()).square().colwise().sum() / seeds / (seeds - 1)).sqrt();
  std::printf("| %s | %+.2f +- %.2f | %+.2f +- %.2f | %.0f |\n", name, mean[0], error[0], mean[1], error[1],
              100.0 * valid);
}

void printTable(int seeds) {
  for (const char* scenario : {"paper_clean", "iso_road"}) {
    SimulationOptions drive;
    drive.scenario = scenario;
    drive.duration = 60.0;
    drive.rate = 1.0 / kAlignedPeriod;
    std::printf("\n| %s | b1 [%%] | b0 [%%] | valid [%%] |\n|---|---|---|---|\n", scenario);
    print("200 Hz both, in step, resampled", seeds, drive, Alignment::kResampled);
    drive.unsprung_rate = 333.0;
    drive.unsprung_phase = 0.0011;
    print("200 and 333 Hz", seeds, drive, Alignment::kAuto);
    drive.dropout = 0.02;
    print("... and 2 % lost", seeds, drive, Alignment::kAuto);
    drive.sampling_jitter = 0.001;
    print("... and taken up to 1 ms late", seeds, drive, Alignment::kAuto);
    print("the same, paired", seeds, drive, Alignment::kPaired);
    drive.stamp_jitter = 0.001;
    print("... and stamped up to 1 ms late besides", seeds, drive, Alignment::kAuto);
    drive.sampling_jitter = 0.0;
    print("stamped late only", seeds, drive, Alignment::kAuto);
  }
}

int loop(std::string_view alignment_name, double rate, long count) {
  UniformGrid grid(kAlignedPeriod, {alignment(alignment_name), 240});
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
  printTable(argc == 2 ? std::max(2, std::atoi(argv[1])) : 20);
}
