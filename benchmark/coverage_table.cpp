// Prints the table of doc/uncertainty.md: how often the estimates plus and minus 1.96 stddev hold the truth, over
// roads, vehicles, noise, horizons and forgetting factors.
//   coverage_table [SEEDS [FASTEST]]      measurements of each drive, default 10; fastest_memory [s]
#include <cstdio>
#include <cstdlib>
#include <optional>

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
constexpr double kHorizons[] = {0.6, 1.0, 1.6};  // times the proposed one
constexpr double kForgettingFactors[] = {0.98, 0.99, 0.995};

void printRow(const char* name, const char* horizon, const char* lambda, const Coverages& coverages) {
  std::printf("| %s | %s | %s |", name, horizon, lambda);
  for (const auto& estimator : coverages)
    for (const Coverage& coverage : estimator) std::printf(" %.1f, %.2f |", 100.0 * coverage.share(), coverage.rms());
  std::printf("\n");
}

void printTable(int seeds, std::optional<double> fastest) {
  std::printf(
      "| drive | L / proposed | lambda | LS b1: %%, rms z | LS b0 | LA b1 | LA b0 |\n|---|---|---|---|---|---|---|\n");
  Coverages all;
  for (const Case& drive : kCases) {
    SimulationOptions simulation;
    simulation.scenario = drive.scenario;
    simulation.vehicle = drive.vehicle;
    simulation.iso_class = drive.iso_class;
    simulation.rate = drive.rate;
    simulation.duration = 300.0;
    const CleanDrive clean = cleanDrive(simulation);
    const int proposed = proposedHorizon(clean, drive.noise);
    for (const double horizon : kHorizons)
      for (const double forgetting_factor : kForgettingFactors) {
        MonitorSettings options;
        options.integration_horizon = std::max(5L, std::lround(horizon * proposed)) / simulation.rate;
        options.forgetting_factor = forgetting_factor;
        options.fastest_memory = fastest;
        const Coverages coverages = coverageOf(clean, drive.noise, options, seeds);
        printRow(drive.name, std::to_string(horizon).substr(0, 3).c_str(),
                 std::to_string(forgetting_factor).substr(0, 5).c_str(), coverages);
        all += coverages;
      }
  }
  printRow("**all**", "", "", all);
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  suspension_health_monitor::printTable(argc > 1 ? std::atoi(argv[1]) : 10,
                                        argc > 2 ? std::optional<double>(std::atof(argv[2])) : std::nullopt);
}
