// Prints how often the block estimate plus and minus 1.96 stddev holds the truth, over roads, vehicles and noise.
//   coverage_table [SEEDS]      measurements of each drive, default 10
#include <cstdio>
#include <cstdlib>

#include "../test/core/interval_coverage.h"

namespace suspension_health_monitor {
namespace {

struct Case {
  const char* name;
  const char* scenario;
  const char* vehicle;
  const char* iso_class;
  double rate, noise;  // [Hz], [m/s^2]
};
// Sampled well above twice what the wheel does: integration errors of faster motion are no part of stddev.
constexpr Case kCases[] = {{"paper's road, noise 0.024", "paper_clean", "default", "default", 50, 0.024},
                           {"paper's road, noise 0.1", "paper_clean", "default", "default", 50, 0.1},
                           {"paper's vehicle, ISO road", "iso_road", "paper", "default", 100, 0.024},
                           {"car, class A", "iso_road", "golden_car", "A", 200, 0.03},
                           {"car, class C", "iso_road", "golden_car", "C", 200, 0.03},
                           {"rover", "iso_road", "rover", "default", 200, 0.03},
                           {"UGV", "iso_road", "ugv", "default", 200, 0.03},
                           {"UGV, class B, noise 0.1", "iso_road", "ugv", "B", 200, 0.1}};

void printRow(const char* name, const Coverages& coverages) {
  std::printf("| %s |", name);
  for (const Coverage& coverage : coverages) std::printf(" %.1f, %.2f |", 100.0 * coverage.share(), coverage.rms());
  std::printf("\n");
  std::fflush(stdout);
}

void printTable(int seeds) {
  std::printf("| drive | b1: %%, rms z | b0 |\n|---|---|---|\n");
  Coverages all;
  for (const Case& drive : kCases) {
    SimulationOptions simulation;
    simulation.scenario = drive.scenario;
    simulation.vehicle = drive.vehicle;
    simulation.iso_class = drive.iso_class;
    simulation.rate = drive.rate;
    simulation.duration = 300.0;
    const Coverages coverages = coverageOf(cleanDrive(simulation), drive.noise, {}, seeds);
    printRow(drive.name, coverages);
    all += coverages;
  }
  printRow("**all**", all);
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) { suspension_health_monitor::printTable(argc > 1 ? std::atoi(argv[1]) : 10); }
